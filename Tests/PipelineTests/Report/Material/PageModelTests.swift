import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct PageModelTests {
  private func context() -> StageContext { StageContext(control: KernelControl()) }

  private func numbers<Number: FixedWidthInteger & BitwiseCopyable>(
    _ data: Data, as type: Number.Type
  ) -> [Number] {
    data.withUnsafeBytes { bytes in
      (0..<bytes.count / MemoryLayout<Number>.size).map {
        Number(
          littleEndian: bytes.loadUnaligned(
            fromByteOffset: $0 * MemoryLayout<Number>.size, as: Number.self))
      }
    }
  }

  private func positions(_ model: PageModel) -> [SIMD3<Float>] {
    let numbers = numbers(model.positions, as: UInt16.self).map(Float.init)
    return stride(from: 0, to: numbers.count, by: 3).map {
      model.origin + model.size / 65535 * SIMD3(numbers[$0], numbers[$0 + 1], numbers[$0 + 2])
    }
  }

  /// A textured square of two triangles whose corners 0 and 2 have two texture coordinates.
  private var square: TexturedMesh {
    let mesh = Mesh(
      positions: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.5]],
      normals: [SIMD3<Float>](repeating: [0, 0, 1], count: 4),
      triangles: [Triangle(0, 1, 2), Triangle(0, 2, 3)])
    let image = RasterImage(width: 8, height: 8, channels: 3, filledWith: 100)
    return TexturedMesh(
      mesh: mesh,
      textureCoordinates: [[0, 0], [0.5, 0], [0.5, 0.5], [1, 1], [0.5, 1], [0, 1]],
      textureTriangles: [Triangle(0, 1, 2), Triangle(3, 4, 5)],
      atlases: [TextureAtlas(triangles: 0..<2, maps: [.diffuseColor: image])])
  }

  @Test func verticesAreSplitWhereChartsMeet() throws {
    let model = try PageModel(square, [], context())
    let positions = positions(model)
    #expect(positions.count == 6)
    let triangles = numbers(model.triangles, as: UInt16.self)
    let corners = [0, 1, 2, 0, 2, 3].map { square.mesh.positions[$0] }
    for (vertex, corner) in zip(triangles, corners) {
      #expect((positions[Int(vertex)] - corner).length < 2e-5)
    }
    let coordinates = numbers(model.coordinates, as: UInt16.self)
    #expect(coordinates.count == 12 && coordinates[2] == 32768 && coordinates[6] == 65535)
    #expect(model.parts.count == 1 && model.parts[0].count == 2)
    #expect(model.parts[0].texture?.hasPrefix("data:image/jpeg;base64,") == true)
    #expect(numbers(model.normals, as: Int8.self).prefix(3) == [0, 0, 127])
  }

  @Test func figuresFollowTheVertices() throws {
    let figure = VertexFigures(
      .photos, "n", "u", [0, 5, 10, .nan], high: 10)
    let model = try PageModel(square, [figure], context())
    let order = numbers(model.triangles, as: UInt16.self)
    let bytes = [UInt8](try #require(model.maps.first).values)
    #expect(order.map { bytes[Int($0)] } == [0, 127, 254, 0, 254, 255])
  }

  @Test func largeModelsAreSimplifiedWithColors() throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 4)
    var colored = mesh
    colored.colors = mesh.positions.map { $0.x > 0 ? [200, 0, 0] : [0, 0, 200] }
    let model = TexturedMesh(
      mesh: colored, textureCoordinates: [], textureTriangles: [], atlases: [])
    var options = PageModel.Options()
    options.maximumTriangles = 500
    let heights = VertexFigures(
      .photos, "n", "u", mesh.positions.map { max(0, $0.y) }, high: 1)
    let page = try PageModel(model, [heights], options: options, context())
    let positions = positions(page)
    #expect((300...500).contains(page.triangleCount))
    let colors = [UInt8](page.colors)
    let values = [UInt8](page.maps[0].values)
    for (vertex, position) in positions.enumerated() where abs(position.x) > 0.2 {
      #expect(colors[3 * vertex] == (position.x > 0 ? 200 : 0))
      #expect(abs(Float(values[vertex]) / 254 - max(0, position.y)) < 0.1)
    }
  }

  /// Numbers of files may be of any size.
  @Test func extremeNumbersDoNotTrap() throws {
    let huge = Float.greatestFiniteMagnitude
    var part = LoadedModel.Part()
    part.positions = [[-huge, 0, 0], [huge, huge, 0], [0, -huge, huge]]
    part.normals = [[huge, huge, 0], .zero, [0, 0, -huge]]
    part.textureCoordinates = [[-huge, 0], [huge, huge], [0, -huge]]
    part.triangles = [Triangle(0, 1, 2)]
    part.baseColor = EncodedImage(
      fileExtension: "png",
      bytes: try ImageCodec.encodePNG(
        RasterImage(width: 2, height: 2, channels: 3, filledWith: 9)))
    let page = try PageModel(LoadedModel(parts: [part]), KernelControl())
    #expect(numbers(page.positions, as: UInt16.self).count == 9)
    #expect(numbers(page.normals, as: Int8.self).count == 9)
    #expect(numbers(page.coordinates, as: UInt16.self).count == 6)
    #expect(page.size.isFinite && page.coordinateSize.x.isFinite)
  }
}
