import ArgumentParser
import RealityKit

/// The part of the surface that a model shows, and the kind of its faces.
package struct ShapeArguments: ParsableArguments {
  @Option(
    name: .long, parsing: .unconditional,
    help: ArgumentHelp(
      "Crop the model to the box with these opposite corners, in the model's frame and unit.",
      valueName: "x,y,z,x,y,z"))
  package var crop: BoxArgument?

  @Flag(
    name: .long,
    help: "Merge pairs of triangles into quads where they fit together; GLB has triangles only.")
  package var quads = false

  package init() {}

  /// The crop box of a session's request; nil for the whole surface.
  package var geometry: PhotogrammetrySession.Request.Geometry? {
    crop.map { .init(bounds: $0.box) }
  }

  /// The kind of faces in a session's configuration.
  package var primitive: PhotogrammetrySession.Configuration.MeshPrimitive {
    quads ? .quad : .triangle
  }
}

/// A box by two opposite corners.
package struct BoxArgument: ExpressibleByArgument, Equatable {
  /// The axis-aligned box.
  package let box: BoundingBox

  /// Parses `x,y,z,x,y,z`; nil unless these are finite numbers and the box has a volume.
  package init?(argument: String) {
    let numbers = argument.split(separator: ",", omittingEmptySubsequences: false)
      .map { Float($0.filter { $0 != " " }) }
    guard numbers.count == 6, numbers.allSatisfy({ $0?.isFinite == true }) else { return nil }
    let (p, q) = (numbers[..<3].map { $0 ?? 0 }, numbers[3...].map { $0 ?? 0 })
    let corners = zip(p, q).map { (min($0, $1), max($0, $1)) }
    guard corners.allSatisfy({ $0.0 < $0.1 }) else { return nil }
    box = BoundingBox(
      min: SIMD3(corners[0].0, corners[1].0, corners[2].0),
      max: SIMD3(corners[0].1, corners[1].1, corners[2].1))
  }
}
