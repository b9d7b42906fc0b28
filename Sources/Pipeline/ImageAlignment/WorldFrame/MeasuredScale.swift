import SceneModel

/// The metric scale of a reconstruction from measured distances.
struct MeasuredScale: Sendable {
  /// Meters per unit of the reconstruction, by least squares over all usable distances.
  var metersPerUnit: Double
  /// For each used distance, the relative deviation of the scaled reconstruction from the measured
  /// value.
  var deviations: [Double]

  /// Maximum reprojection error of a pick, as a fraction of the photo's longer side. Chosen.
  static let maximumPickError = 0.01
  /// Maximum relative deviation of a distance from its measured value without a warning. Chosen.
  static let maximumDeviation = 0.02
  /// Minimum of 1 − cos α for two rays at an angle α to determine a point. Chosen: 2.6°.
  static let minimumIntersection = 0.001

  /// Estimates the scale. It is nil without a usable distance; `problems` are messages about
  /// distances that are unusable or inconsistent.
  static func measure(
    _ distances: [KnownDistance], in reconstruction: Reconstruction
  ) -> (scale: MeasuredScale?, problems: [String]) {
    var problems: [String] = []
    var used: [(length: Double, meters: Double)] = []
    for distance in distances {
      do throws(UnusableDistance) {
        let a = try position(of: distance.from, in: reconstruction, &problems)
        let b = try position(of: distance.to, in: reconstruction, &problems)
        guard KnownDistance.possibleMeters.contains(distance.meters) else {
          throw UnusableDistance(reason: "it must be \(KnownDistance.possibleMetersText)")
        }
        guard (a - b).length > 0 else {
          throw UnusableDistance(reason: "its ends are the same place")
        }
        used.append(((a - b).length, distance.meters))
      } catch {
        problems.append(
          "The known distance of \(distance.meters) m can't be used: \(error.reason).")
      }
    }
    // Pick errors are the same for all distances: the least-squares scale is Σlm / Σl².
    let squares = used.reduce(0) { $0 + $1.length * $1.length }
    guard squares > 0 else { return (nil, problems) }
    let scale = used.reduce(0) { $0 + $1.length * $1.meters } / squares
    let deviations = used.map { scale * $0.length / $0.meters - 1 }
    if let worst = deviations.map({ abs($0) }).max(), worst > maximumDeviation {
      problems.append(
        "The known distances disagree by up to \(Int(saturating: 100 * worst)) %; check them "
          + "and their end points.")
    }
    return (MeasuredScale(metersPerUnit: scale, deviations: deviations), problems)
  }

  /// Why a distance is unusable; `reason` completes "The known distance can't be used: …".
  private struct UnusableDistance: Error {
    var reason: String
  }

  /// The position of an end, in the frame of the reconstruction.
  private static func position(
    of end: KnownDistance.End, in reconstruction: Reconstruction, _ problems: inout [String]
  ) throws(UnusableDistance) -> SIMD3<Double> {
    switch end {
    case .camera(let name): return try photo(name, reconstruction).pose.center
    case .point(let picks): return try point(picks, reconstruction, &problems)
    }
  }

  private static func photo(
    _ name: String, _ reconstruction: Reconstruction
  ) throws(UnusableDistance) -> (camera: Camera, pose: RigidTransform) {
    guard let photo = reconstruction.photos.first(where: { $0.name == name }) else {
      throw UnusableDistance(reason: "\(name) is not among the photos that are used")
    }
    guard let pose = reconstruction.poses[photo.id.index] else {
      throw UnusableDistance(reason: "\(name) could not be aligned")
    }
    return (reconstruction.camera(of: photo.id), pose)
  }

  private typealias View = (pick: KnownDistance.Pick, camera: Camera, pose: RigidTransform)

  /// Triangulates a point from the rays of its picks.
  private static func point(
    _ picks: [KnownDistance.Pick], _ reconstruction: Reconstruction, _ problems: inout [String]
  ) throws(UnusableDistance) -> SIMD3<Double> {
    var views: [View] = []
    for pick in picks {
      let (camera, pose) = try photo(pick.photo, reconstruction)
      views.append((pick, camera, pose))
    }
    guard let point = intersection(views) else {
      throw UnusableDistance(
        reason: "a point needs picks in two photos or more that were taken from different sides")
    }
    for view in views {
      let inCamera = view.pose * point
      guard inCamera.z > 0 else {
        throw UnusableDistance(reason: "the picks of a point don't show the same place")
      }
      let error = (view.camera.project(inCamera) - [view.pick.x, view.pick.y]).length
      if error > maximumPickError * view.camera.longerSide {
        problems.append(
          "A pick in \(view.pick.photo) is \(Int(saturating: error)) pixels away from the point "
            + "picked in the other photos; check that all picks show the same point.")
      }
    }
    return point
  }

  /// The point with the least sum of squared distances from the rays; nil if they are nearly
  /// parallel.
  private static func intersection(_ views: [View]) -> SIMD3<Double>? {
    var matrix = Matrix3(rows: .zero, .zero, .zero)
    var right = SIMD3<Double>.zero
    for view in views {
      let ray = view.camera.unproject([view.pick.x, view.pick.y])
      let direction = (view.pose.rotation.conjugate * SIMD3(ray.x, ray.y, 1)).normalized
      // Σ (I − d dᵀ) (x − c) = 0
      let rows = (0..<3).map { axis -> SIMD3<Double> in
        var row = -direction[axis] * direction
        row[axis] += 1
        return row
      }
      matrix.row0 += rows[0]
      matrix.row1 += rows[1]
      matrix.row2 += rows[2]
      let center = view.pose.center
      right += [rows[0].dot(center), rows[1].dot(center), rows[2].dot(center)]
    }
    // For two rays at an angle α the smallest eigenvalue is 1 − cos α.
    guard views.count >= 2, matrix.symmetricEigen.values[0] > minimumIntersection else {
      return nil
    }
    return matrix.solution(of: right)
  }
}
