import RealityKit
import Testing

@testable import SharedCommands

@Suite struct ShapeArgumentsTests {
  @Test func boxesAndQuadsAreParsed() throws {
    let shape = try ShapeArguments.parse([
      "--crop", "-1,0.5,2,1,-2, 3e-1", "--quads",
    ])
    #expect(shape.geometry?.bounds == BoundingBox(min: [-1, -2, 0.3], max: [1, 0.5, 2]))
    #expect(shape.primitive == .quad)
    let plain = try ShapeArguments.parse([])
    #expect(plain.geometry == nil && plain.primitive == .triangle)
    for wrong in ["1,2,3", "0,0,0,1,1,0", "0,0,0,1,1,x", "0,0,0,1,1,nan", "0,0,0,1,1,1,1"] {
      #expect(throws: (any Error).self) { try ShapeArguments.parse(["--crop", wrong]) }
    }
  }
}
