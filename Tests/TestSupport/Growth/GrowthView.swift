import Foundation
import SceneModel

/// The features observed by one camera of a `GrowthScene`.
struct GrowthView {
  private struct VisiblePoint {
    var point: Int
    var pixel: SIMD2<Double>
    var scale: Double
    /// What the descriptor depends on: two components of the viewing direction, and log₂ of the
    /// distance.
    var appearance: SIMD3<Float>
    var strength: Double
  }

  /// Scales in pixels that a detector finds.
  private static let scales = 1.6...24.0
  /// Fraction of the visible points that are detected.
  private static let repeatability = 0.75

  private let world: GrowthWorld
  private let pose: RigidTransform
  private let options: GrowthScene.Options

  init(_ world: GrowthWorld, _ pose: RigidTransform, _ options: GrowthScene.Options) {
    (self.world, self.pose, self.options) = (world, pose, options)
  }

  func features(
    _ descriptors: GrowthDescriptors, _ random: inout SeededGenerator
  ) -> (features: FeatureSet, points: [Int32]) {
    let targetCount = Int(Double(options.featuresPerPhoto) * (1 - options.clutterRatio))
    let strongest = visiblePoints(&random).sorted { $0.strength > $1.strength }.prefix(targetCount)
    let clutter = clutter(
      Int(Double(strongest.count) * options.clutterRatio / (1 - options.clutterRatio)), &random)
    let all = (strongest + clutter).sorted { $0.scale > $1.scale }
    var set = FeatureSet(
      positions: all.map { SIMD2<Float>($0.pixel) }, scales: all.map { Float($0.scale) },
      orientations: [Float](repeating: 0, count: all.count),
      colors: [SIMD3<UInt8>](repeating: [128, 128, 128], count: all.count))
    set.descriptors.reserveCapacity(all.count * FeatureSet.descriptorLength)
    for seen in all {
      let key = seen.point < 0 ? random.next() : world.points[seen.point].key
      descriptors.append(key, seen.appearance, to: &set.descriptors, &random)
    }
    return (set, all.map { Int32($0.point) })
  }

  private func visiblePoints(_ random: inout SeededGenerator) -> [VisiblePoint] {
    let eye = pose.center
    var found: [VisiblePoint] = []
    for patch in world.patches where mayBeSeen(patch, from: eye) {
      let right = patch.normal.cross(abs(patch.normal.y) < 0.9 ? [0, 1, 0] : [1, 0, 0]).normalized
      let up = right.cross(patch.normal)
      for index in patch.points {
        guard random.uniform() < Self.repeatability,
          let point = visiblePoint(index, patch.normal, right, up, &random)
        else { continue }
        found.append(point)
      }
    }
    return found
  }

  private func mayBeSeen(_ patch: GrowthWorld.Patch, from eye: SIMD3<Double>) -> Bool {
    let toEye = eye - patch.center
    let inCamera = pose * patch.center
    return toEye.length < world.range && toEye.dot(patch.normal) > 0.2 * toEye.length
      && inCamera.z > -patch.radius
      && abs(inCamera.x) < inCamera.z + 2 * patch.radius
  }

  private func visiblePoint(
    _ index: Int, _ normal: SIMD3<Double>, _ right: SIMD3<Double>, _ up: SIMD3<Double>,
    _ random: inout SeededGenerator
  ) -> VisiblePoint? {
    let (point, camera) = (world.points[index], options.camera)
    let position = SIMD3<Double>(point.position)
    let inCamera = pose * position
    guard inCamera.z > 0.2 else { return nil }
    let pixel = camera.project(inCamera)
    let toEye = pose.center - position
    let distance = toEye.length
    let scale = Double(point.size) * camera.focalLength.x / distance
    guard pixel.x > 8, pixel.y > 8, pixel.x < Double(camera.width) - 8,
      pixel.y < Double(camera.height) - 8, Self.scales.contains(scale),
      !world.isHidden(position, from: pose.center)
    else { return nil }
    let (x, y) = (random.normal(), random.normal())
    let view = SIMD3(toEye.dot(right) / distance, toEye.dot(up) / distance, log2(distance))
    // Points have roughly the same strength in every photo.
    let strength = Double(point.key >> 11) * 0x1p-53 + 0.15 * random.normal()
    return VisiblePoint(
      point: index, pixel: pixel + options.pixelNoise * SIMD2(x, y),
      scale: scale * (1 + 0.05 * random.normal()), appearance: SIMD3<Float>(view),
      strength: strength)
  }

  /// Features that no other photo shows.
  private func clutter(_ count: Int, _ random: inout SeededGenerator) -> [VisiblePoint] {
    (0..<count).map { _ in
      let (x, y) = (random.uniform(), random.uniform())
      return VisiblePoint(
        point: -1, pixel: [x * Double(options.camera.width), y * Double(options.camera.height)],
        scale: min(Self.scales.upperBound, 1.6 / max(0.05, random.uniform().squareRoot())),
        appearance: .zero, strength: 0)
    }
  }
}
