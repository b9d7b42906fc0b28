import Foundation
import SceneModel

/// The surfaces and cameras of a `GrowthScene`.
struct GrowthWorld: Sendable {
  /// A point of texture; `size` is the size of its scale σ in world units.
  struct Point: Sendable {
    var position: SIMD3<Float>
    var size: Float
    /// Identifies its appearance.
    var key: UInt64
  }

  /// A small planar surface patch and its points.
  struct Patch: Sendable {
    var center: SIMD3<Double>
    var normal: SIMD3<Double>
    var radius: Double
    var points: Range<Int>
  }

  private(set) var points: [Point] = []
  private(set) var patches: [Patch] = []
  private(set) var poses: [RigidTransform] = []
  /// Distance beyond which points are not observed.
  private(set) var range = Double.infinity
  private var town: GrowthTown?

  init(_ options: GrowthScene.Options, _ random: inout SeededGenerator) {
    switch options.layout {
    case .streets:
      let town = GrowthTown(photoCount: options.photoCount)
      self.town = town
      range = 60
      for facade in town.facades { addFacade(facade, &random) }
      poses = town.drive(photoCount: options.photoCount, &random)
    case .orbits:
      addBall(&random)
      poses = Self.orbits(options.photoCount, &random)
    }
  }

  /// Whether a building occludes a point.
  func isHidden(_ point: SIMD3<Double>, from eye: SIMD3<Double>) -> Bool {
    town?.isHidden(point, from: eye) ?? false
  }

  private mutating func addFacade(_ facade: GrowthTown.Facade, _ random: inout SeededGenerator) {
    let (columns, rows, density) = (6, 2, 15.0)
    let (width, height) = (facade.width / Double(columns), GrowthTown.height / Double(rows))
    for index in 0..<(columns * rows) {
      let (column, row) = (Double(index % columns), Double(index / columns))
      let corner = facade.corner + facade.along * (column * width) + [0, row * height, 0]
      let start = points.count
      for _ in 0..<Int(width * height * density) {
        let depth = 0.3 * random.uniform()
        add(
          corner + facade.along * (width * random.uniform()) + [0, height * random.uniform(), 0]
            - facade.normal * depth, smallest: 0.03, &random)
      }
      patches.append(
        Patch(
          center: corner + facade.along * (width / 2) + [0, height / 2, 0], normal: facade.normal,
          radius: (width * width + height * height).squareRoot() / 2 + 0.3,
          points: start..<points.count))
    }
  }

  /// A ball of radius 1 with bumps.
  private mutating func addBall(_ random: inout SeededGenerator) {
    let (count, pointsOfPatch) = (800, 20)
    for index in 0..<count {
      let height = 1 - (2 * Double(index) + 1) / Double(count)
      let (angle, radius) = (2.399963 * Double(index), (1 - height * height).squareRoot())
      let direction = SIMD3(radius * cos(angle), height, radius * sin(angle))
      let bump = 1 + 0.08 * sin(5 * direction.x) * sin(4 * direction.y + 3 * direction.z)
      let start = points.count
      for _ in 0..<pointsOfPatch {
        let offset = 0.06 * random.normal3()
        add((direction + offset).normalized * bump, smallest: 0.006, &random)
      }
      patches.append(
        Patch(
          center: direction * bump, normal: direction, radius: 0.2, points: start..<points.count))
    }
  }

  /// Adds a point with a random size such that the number of points per pixel is the same at every
  /// distance.
  private mutating func add(
    _ position: SIMD3<Double>, smallest: Double, _ random: inout SeededGenerator
  ) {
    let size = smallest / max(0.05, random.uniform().squareRoot())
    points.append(
      Point(position: SIMD3<Float>(position), size: Float(size), key: random.next()))
  }

  private static func orbits(
    _ count: Int, _ random: inout SeededGenerator
  ) -> [RigidTransform] {
    let rings = max(2, Int((Double(count) / 8).squareRoot().rounded()))
    return (0..<count).map { index in
      let ring = index * rings / count
      let elevation = (5 + 60 * Double(ring) / Double(rings - 1)) * .pi / 180
      let distance = (ring % 2 == 0 ? 2.4 : 3) + 0.2 * random.uniform()
      let first = (ring * count + rings - 1) / rings
      let next = ((ring + 1) * count + rings - 1) / rings
      let angle =
        2 * .pi * (Double(index - first) + 0.3 * random.uniform()) / Double(max(1, next - first))
      let eye =
        distance * SIMD3(cos(elevation) * sin(angle), sin(elevation), cos(elevation) * cos(angle))
      return RigidTransform.lookingAt(0.1 * random.normal3(), from: eye)
    }
  }
}
