import Foundation
import Kernels
import SceneModel

/// Removes unreliable parts of a whole scene: the distant background, whose depth is uncertain, and
/// small floating components.
struct SceneTrimming {
  struct Options: Hashable, Codable, Sendable {
    /// Points with a footprint above this many medians are distant background. Chosen.
    var maximumFootprints = 8.0
    /// Points whose viewing directions differ by less than this, in degrees, have no reliable
    /// depth. Chosen.
    var minimumParallaxDegrees = 1.0
    /// Side of a voxel for connecting points, in median footprints. Chosen.
    var connectionFootprints = 6.0
    /// Components with fewer points are removed. Chosen.
    var minimumPoints = 100
    /// The same as a share of all points. Chosen.
    var minimumShare = 0.0005

    init() {}
  }

  var options = Options()

  /// Whether each point is kept.
  func run(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> [Bool] {
    guard let median = cloud.medianFootprint else { return cloud.positions.map { _ in false } }
    let limit = median * Float(options.maximumFootprints)
    let centers = reconstruction.poses.map { $0?.center }
    let minimumCosine = cos(options.minimumParallaxDegrees * .pi / 180)
    let unit = 8192  // Points of a unit of parallel work. Chosen.
    let control = context.control.part(from: 0, to: 0.4)
    var isKept = try control.parallelMap(cloud.count, inUnitsOf: unit) {
      $0.map { cloud.footprints[$0] <= limit && hasParallax(cloud, $0, centers, minimumCosine) }
    }
    let grid = try VoxelGrid(
      cloud.positions.voided(unless: isKept),
      cellSize: Double(median) * options.connectionFootprints, findsComponents: true,
      context.control.part(from: 0.4, to: 1))
    var counts = [Int](repeating: 0, count: grid.componentCount)
    for component in grid.components where component >= 0 { counts[Int(component)] += 1 }
    let minimum = max(
      options.minimumPoints, Int(options.minimumShare * Double(counts.reduce(0, +))))
    for (index, component) in grid.components.enumerated() where isKept[index] {
      isKept[index] = component >= 0 && counts[Int(component)] >= minimum
    }
    // In a small cloud all components are below the limit; keep them rather than nothing.
    return isKept.contains(true) ? isKept : cloud.positions.map { $0.x.isFinite }
  }

  /// Whether two photos see the point at a sufficient triangulation angle.
  private func hasParallax(
    _ cloud: PointCloud, _ index: Int, _ centers: [SIMD3<Double>?], _ minimumCosine: Double
  ) -> Bool {
    let position = SIMD3<Double>(cloud.positions[index])
    var first: SIMD3<Double>?
    for visibility in cloud.visibilities(of: index) {
      let photo = Int(cloud.photoIndices[visibility])
      guard photo < centers.count, let center = centers[photo] else { continue }
      let direction = (position - center).normalized
      guard let reference = first else {
        first = direction
        continue
      }
      if direction.dot(reference) < minimumCosine { return true }
    }
    return false
  }
}
