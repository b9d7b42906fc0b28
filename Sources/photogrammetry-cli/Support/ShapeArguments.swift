import ArgumentParser
import RealityKit

/// What part of the surface a model shows, and of which faces.
struct ShapeArguments: ParsableArguments {
  @Option(
    name: .long, parsing: .unconditional,
    help: ArgumentHelp(
      "Cut off what is outside of a box, given by two opposite corners in the model's frame.",
      valueName: "x,y,z,x,y,z"))
  var crop: BoxArgument?

  @Flag(
    name: .long,
    help: "Join triangles to four-sided faces where they fit together; not in GLB.")
  var quads = false

  /// The part of the surface as the session takes it; nil for all of it.
  var geometry: PhotogrammetrySession.Request.Geometry? { crop.map { .init(bounds: $0.box) } }

  /// The faces as the session takes them.
  var primitive: PhotogrammetrySession.Configuration.MeshPrimitive { quads ? .quad : .triangle }
}

/// A box by two opposite corners.
struct BoxArgument: ExpressibleByArgument, Equatable {
  let box: BoundingBox

  init?(argument: String) {
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
