import SceneModel

/// The focus of the photos: the point nearest to all optical axes, and the share of photos that
/// have a point in their frame.
struct ViewFocus: Sendable {
  /// Number of rounds of iteratively reweighted least squares. Chosen.
  private static let rounds = 10
  /// Minimum residual that a weight is the inverse of, in typical depths. Chosen.
  private static let minimumResidual = 0.05
  /// Weight of an anchor relative to that of its axis. Chosen.
  private static let anchorWeight = 0.05

  /// World frame.
  var point: SIMD3<Double>
  /// Median distance of the cameras to `point`, in world units.
  var distance: Double
  private var views: [View]

  private struct View: Sendable {
    var photo: Int
    var pose: RigidTransform
    var rotation: Matrix3
    var camera: Camera

    var axis: SIMD3<Double> { rotation.row2 }
  }

  /// Nil without a registered photo or if all cameras coincide.
  ///
  /// `depths` holds the median depth of each photo's points, nil if unknown. It determines the
  /// focus along nearly parallel axes.
  init?(_ reconstruction: Reconstruction, depths: [Double?]) {
    views = reconstruction.registered.compactMap { id in
      guard let pose = reconstruction.poses[id.index] else { return nil }
      return View(
        photo: id.index, pose: pose, rotation: pose.rotation.matrix,
        camera: reconstruction.camera(of: id))
    }
    let known = depths.compactMap { $0 }.filter { $0 > 0 && $0.isFinite }
    guard !views.isEmpty, let typical = known.upperMedian else { return nil }
    let anchors = views.map { view -> SIMD3<Double> in
      let depth = depths.indices.contains(view.photo) ? depths[view.photo] : nil
      return view.pose.center + (depth ?? typical) * view.axis
    }
    var weights = [Double](repeating: 1, count: views.count)
    point = .zero
    for _ in 0..<Self.rounds {
      guard let solution = Self.intersect(views, anchors, weights) else { return nil }
      point = solution
      for (index, view) in views.enumerated() {
        let offset = point - view.pose.center
        let residual = (offset - offset.dot(view.axis) * view.axis).length
        weights[index] = 1 / max(Self.minimumResidual * typical, residual)
      }
    }
    let focus = point
    guard let median = views.map({ ($0.pose.center - focus).length }).upperMedian, median > 0,
      median.isFinite
    else { return nil }
    distance = median
  }

  /// Camera centers in photo order, world frame.
  var centers: [SIMD3<Double>] { views.map(\.pose.center) }

  /// The mean of the photos' up directions; zero if they cancel out.
  var meanUp: SIMD3<Double> {
    views.reduce(SIMD3<Double>.zero) { $0 - $1.rotation.row1 }.normalized
  }

  /// The share of photos that have a point in their frame, 0…1.
  func coverage(of position: SIMD3<Double>) -> Double {
    var count = 0
    for view in views {
      let p = view.rotation * position + view.pose.translation
      guard p.z > 0 else { continue }
      let x = view.camera.focalLength.x * p.x / p.z + view.camera.principalPoint.x
      let y = view.camera.focalLength.y * p.y / p.z + view.camera.principalPoint.y
      if view.camera.contains([x, y]) { count += 1 }
    }
    return Double(count) / Double(views.count)
  }

  /// The point with the least weighted squared distance to the axes, weakly attracted to the
  /// anchors (iteratively reweighted by the caller).
  private static func intersect(
    _ views: [View], _ anchors: [SIMD3<Double>], _ weights: [Double]
  ) -> SIMD3<Double>? {
    var matrix = Matrix3(rows: .zero, .zero, .zero)
    var right = SIMD3<Double>.zero
    for (index, view) in views.enumerated() {
      let (d, w, pull) = (view.axis, weights[index], anchorWeight * weights[index])
      let rows: [SIMD3<Double>] = [
        [1 - d.x * d.x, -d.x * d.y, -d.x * d.z], [-d.x * d.y, 1 - d.y * d.y, -d.y * d.z],
        [-d.x * d.z, -d.y * d.z, 1 - d.z * d.z],
      ]
      let projector = Matrix3(rows: rows[0], rows[1], rows[2])
      right += w * (projector * view.pose.center) + pull * anchors[index]
      matrix.row0 += w * rows[0] + SIMD3(pull, 0, 0)
      matrix.row1 += w * rows[1] + SIMD3(0, pull, 0)
      matrix.row2 += w * rows[2] + SIMD3(0, 0, pull)
    }
    return matrix.solution(of: right)
  }
}
