import Foundation
import SceneModel

/// Determines the scale, the up direction and the origin of the world frame.
///
/// +y is up and the object stands on y = 0, centered in x and z on the points that most photos
/// show. Scale, in order of preference: known distances, depth maps, GPS; otherwise the median
/// distance from the cameras to the object is defined as one meter. See `UpEstimation` for the up
/// direction.
package struct WorldAlignment: Sendable {
  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the same reconstruction in the new world frame; unchanged without registered photos.
  ///
  /// `posesInUpFrame` has poses of photos, by ID, in a frame whose +y is up.
  package func run(
    _ reconstruction: Reconstruction, posesInUpFrame: [RigidTransform?] = [],
    _ context: StageContext
  ) -> Reconstruction {
    guard let first = reconstruction.registered.first, !reconstruction.points.isEmpty else {
      return reconstruction
    }
    let object = ObjectRegion(reconstruction)
    let estimate = UpEstimation(options: options)
      .run(reconstruction, object, posesInUpFrame: posesInUpFrame, context.notes)
    var frame = WorldFrame(up: estimate.source)
    let scale: Double
    (scale, frame.scale) = self.scale(reconstruction, object, estimate.gps, context.notes)
    let front = (reconstruction.poses[first.index]?.center ?? .zero) - object.center
    let level = Self.leveling(estimate.up)
    let yaw = estimate.gps?.yaw(leveling: level) ?? Self.yaw(facing: level * front)
    var rotation = Self.rotation(level, yaw: yaw)
    var (up, plane) = (estimate.up, estimate.plane)
    if case .model(let axis) = options.chosenUp, axis != .y {
      up = rotation.conjugate * axis.direction
      plane = nil
      let turned = Self.leveling(up)
      rotation = Self.rotation(turned, yaw: Self.yaw(facing: turned * front))
      frame.turnedVertical = rotation * estimate.up
    }
    let ground = ground(object, plane, up)
    let origin = object.center - up * ((object.center - ground).dot(up))
    let worldFromOld = SimilarityTransform(
      scale: scale, rotation: rotation, translation: -scale * (rotation * origin))
    return reconstruction.moved(by: worldFromOld, frame)
  }

  /// A rotation that levels, followed by one about +y, in radians.
  private static func rotation(_ leveling: Quaternion, yaw: Double) -> Quaternion {
    (Quaternion(angle: yaw, axis: [0, 1, 0]) * leveling).normalized
  }

  /// The rotation about +y that turns a direction to the front, +z.
  private static func yaw(facing direction: SIMD3<Double>) -> Double {
    -atan2(direction.x, direction.z)
  }

  /// Meters per unit, and their source.
  private func scale(
    _ reconstruction: Reconstruction, _ object: ObjectRegion, _ gps: GPSFit?, _ notes: StageNotes
  ) -> (Double, WorldFrame.Scale) {
    if let residual = gps?.residual { report(residual, notes) }
    let (measured, problems) = MeasuredScale.measure(options.knownDistances, in: reconstruction)
    problems.forEach(notes.warn)
    if let measured {
      notes.record("knownDistances", Double(measured.deviations.count))
      notes.record("knownDistanceDeviation", measured.deviations.map { abs($0) }.max() ?? 0)
      return (measured.metersPerUnit, .knownDistance)
    }
    let depthScale = DepthMapScale(options: options.depthMaps)
      .run(options.readings, reconstruction, notes)
    if let depthScale { return (depthScale, .depth) }
    if let gps { return (gps.scale, .gps) }
    notes.warn(
      "The photos don't determine the size of the object: its scale is arbitrary, with the "
        + "cameras' median distance from it defined as one meter.")
    return (1 / max(object.cameraDistance, .leastNormalMagnitude), .arbitrary)
  }

  private func report(_ residual: GPSFit.Residual, _ notes: StageNotes) {
    notes.record("gpsPositions", Double(residual.count))
    notes.record("gpsPositionsUsed", Double(residual.used))
    notes.record("gpsHorizontalRMS", residual.horizontal)
    func meters(_ value: Double) -> String { String(format: "%.2f m", value) }
    var sentence = "GPS: \(residual.used) of \(residual.count) positions agree with the cameras; "
    sentence += "root mean square error \(meters(residual.horizontal)) horizontally"
    if let vertical = residual.vertical {
      notes.record("gpsVerticalRMS", vertical)
      sentence += " and \(meters(vertical)) vertically"
    }
    notes.log(sentence + ".")
  }

  /// A point on the ground plane of the object.
  private func ground(
    _ object: ObjectRegion, _ plane: SupportPlane?, _ up: SIMD3<Double>
  ) -> SIMD3<Double> {
    let heights = object.core.map { ($0 - object.center).dot(up) }.sorted()
    let height = heights.isEmpty ? 0 : heights[heights.count / options.groundDivisor]
    let lowest = object.center + up * height
    // A plane that was found for a different up direction, or above the object, is not the ground.
    guard let plane, plane.normal.dot(up) > options.groundCosine else { return lowest }
    return object.center - plane.normal * plane.height(of: object.center)
  }

  /// The smallest rotation that maps `up` to +y.
  static func leveling(_ up: SIMD3<Double>) -> Quaternion {
    let axis = up.cross([0, 1, 0])
    guard axis.length > 1e-12 else {
      return up.y > 0 ? .identity : Quaternion(angle: .pi, axis: [1, 0, 0])
    }
    return Quaternion(angle: atan2(axis.length, up.y), axis: axis)
  }
}

extension Reconstruction {
  /// The same scene in another world frame.
  func moved(by newFromOld: SimilarityTransform, _ frame: WorldFrame) -> Reconstruction {
    var result = self
    result.poses = poses.map { $0.map(newFromOld.applied(toCameraFromA:)) }
    for index in points.indices {
      result.points[index].position = newFromOld * points[index].position
    }
    result.worldFrame = frame
    return result
  }
}
