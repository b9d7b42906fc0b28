import Foundation
import SceneModel

/// Determines which points of a surface are visible to cameras.
struct Visibility: Sendable {
  /// Start and end of the ray from a point to a camera, as fractions of their distance: the ray
  /// must not hit the surface at the point itself. Chosen.
  private static let margin: Float = 1e-3
  private static let limit: Float = 0.999

  let cameras: [NamedCamera]
  let tree: BoundingTree<FlatTriangle>
  let minimumViews: Int
  /// Maximum angle in degrees between the normal of a point, of either sign, and the direction to a
  /// camera.
  let maximumAngleDegrees: Double
  let threadCount: Int

  /// The samples visible to at least `minimumViews` cameras, in their order.
  func visible(_ samples: [SurfaceSample]) -> [SurfaceSample] {
    parallelChunks(samples.count, threads: threadCount) { range in
      var stack = BoundingTree<FlatTriangle>.Stack()
      return range.map { samples[$0] }.filter { isVisible($0, &stack) }
    }
  }

  private func isVisible(
    _ sample: SurfaceSample, _ stack: inout BoundingTree<FlatTriangle>.Stack
  ) -> Bool {
    var views = 0
    for (index, camera) in cameras.enumerated() {
      // Stops as soon as the remaining cameras can't reach the minimum.
      guard views < minimumViews, views + cameras.count - index >= minimumViews else { break }
      if sees(camera, sample, &stack) { views += 1 }
    }
    return views >= minimumViews
  }

  private func sees(
    _ camera: NamedCamera, _ sample: SurfaceSample,
    _ stack: inout BoundingTree<FlatTriangle>.Stack
  ) -> Bool {
    let point = sample.position
    let inCamera = camera.cameraFromWorld * SIMD3<Double>(point)
    guard inCamera.z > 0 else { return false }
    guard camera.camera.contains(camera.camera.project(inCamera)) else { return false }
    let center = SIMD3<Float>(camera.cameraFromWorld.center)
    let direction = center - point
    guard isWithinAngle(direction, sample.normal) else { return false }
    let origin = point + direction * Self.margin
    return !tree.anyItem(from: origin, direction: direction, limit: Self.limit, &stack) {
      $0.isHit(from: origin, direction: direction, limit: Self.limit)
    }
  }

  private func isWithinAngle(_ direction: SIMD3<Float>, _ normal: SIMD3<Double>) -> Bool {
    guard maximumAngleDegrees < 90 else { return true }
    let cosine = abs(normal.dot(SIMD3<Double>(direction).normalized))
    return cosine >= cos(maximumAngleDegrees * .pi / 180)
  }
}
