import Foundation
import Kernels
import SceneModel

/// Viewpoints that see the whole model at one scale: all around its vertical axis, or in front of
/// the photographed side if the photos show only one.
///
/// Azimuth is measured from +z toward +x, elevation upward from the horizon; both in radians.
struct Turntable: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Number of viewpoints. Chosen.
    var viewCount = 8
    /// Approximate angle that a picture spans. Chosen.
    var fieldOfViewDegrees = 30.0
    /// Margin around the model, as a share of a picture's longer side. Chosen.
    var margin = 0.04
    /// Minimum of a picture's shorter side, as a share of the longer one. Chosen.
    var minimumAspect = 0.3
    /// Elevation without photos. Chosen.
    var elevationDegrees = 20.0
    /// Bounds of the photos' median elevation. Chosen.
    var minimumElevationDegrees = 10.0
    var maximumElevationDegrees = 50.0
    /// Photos whose horizontal unit directions have a longer mean than this, 0…1, show one side;
    /// 0.64 corresponds to a semicircle. Chosen: a little less.
    var oneSidedConcentration = 0.6
    /// Minimum mean length, 0…1, of the horizontal part of the photos' unit directions: for photos
    /// from above it carries no information. Chosen.
    var minimumHorizontalShare = 0.2
    /// Bounds of half the angle that viewpoints of a single side span. Chosen.
    var minimumReachDegrees = 40.0
    var maximumReachDegrees = 80.0
    /// Share of the photos that this angle covers. Chosen.
    var reachShare = 0.8
  }

  /// A viewing direction as seen from the model, in radians.
  struct Direction: Hashable, Sendable {
    var azimuth: Double
    var elevation: Double
  }

  var options = Options()

  /// The shared camera of all pictures, and their poses.
  struct Viewpoints: Sendable {
    var camera: Camera
    /// `cameraFromWorld`; empty for an empty model.
    var poses: [RigidTransform]
  }

  /// Viewpoints that see every position within the margins. The pictures are cropped to the model,
  /// their longer side has at most `side` pixels. `cameras` are the poses of the photos.
  func viewpoints(
    of positions: [SIMD3<Float>], cameras: [RigidTransform], side: Int, _ control: KernelControl
  ) throws -> Viewpoints {
    guard let bounds = Mesh(positions: positions).bounds else {
      return Viewpoints(camera: camera(framing: (.zero, .zero), side), poses: [])
    }
    let center = (SIMD3<Double>(bounds.min) + SIMD3<Double>(bounds.max)) / 2
    let rotations = directions(cameras).map(Self.rotation)
    let distances = try control.part(from: 0, to: 0.5).parallelMap(rotations.count) { index in
      leastDistance(of: positions, around: center, rotations[index])
    }
    let distance = distances.max() ?? 1
    let poses = rotations.map { rotation in
      RigidTransform(rotation: rotation, translation: [0, 0, distance] - rotation * center)
    }
    let outlines = try control.part(from: 0.5, to: 1).parallelMap(poses.count) { index in
      Self.outline(of: positions, from: poses[index])
    }
    let outline = outlines.reduce(outlines.first ?? (.zero, .zero)) {
      (pointwiseMin($0.low, $1.low), pointwiseMax($0.high, $1.high))
    }
    return Viewpoints(camera: camera(framing: outline, side), poses: poses)
  }

  /// Two opposite corners of a rectangle at depth 1.
  private typealias Outline = (low: SIMD2<Double>, high: SIMD2<Double>)

  /// The bounding rectangle of all positions in a picture.
  private static func outline(
    of positions: [SIMD3<Float>], from pose: RigidTransform
  ) -> Outline {
    let (matrix, t) = (pose.rotation.matrix, pose.translation)
    var low = SIMD2<Double>(repeating: .infinity)
    var high = -low
    for position in positions {
      let p = SIMD3<Double>(position)
      let point =
        SIMD2(matrix.row0.dot(p) + t.x, matrix.row1.dot(p) + t.y) / (matrix.row2.dot(p) + t.z)
      low = pointwiseMin(low, point)
      high = pointwiseMax(high, point)
    }
    return (low, high)
  }

  /// A camera whose picture holds the outline and the margins.
  private func camera(framing outline: Outline, _ side: Int) -> Camera {
    let extent = outline.high - outline.low
    let longer = max(extent.x, extent.y)
    let focal = Double(side) * (1 - 2 * options.margin) / (longer > 0 ? longer : 1)
    func pixels(_ extent: Double) -> Int {
      let share = max(extent * focal / Double(side) + 2 * options.margin, options.minimumAspect)
      return max(1, min(side, Int((share * Double(side)).rounded(.up))))
    }
    let (width, height) = (pixels(extent.x), pixels(extent.y))
    let middle = (outline.low + outline.high) / 2 * focal
    return Camera(
      width: width, height: height, focalLength: [focal, focal],
      principalPoint: SIMD2(Double(width), Double(height)) / 2 - middle)
  }

  /// Directions of the viewpoints as seen from the model.
  func directions(_ cameras: [RigidTransform]) -> [Direction] {
    let viewDirections = cameras.map { -($0.rotation.conjugate * SIMD3<Double>(0, 0, 1)) }
    let elevation = medianElevation(viewDirections)
    let count = Double(options.viewCount)
    if let side = seenSide(viewDirections) {
      let step = options.viewCount > 1 ? 2 * side.reach / (count - 1) : 0
      return (0..<options.viewCount).map {
        Direction(azimuth: side.azimuth - side.reach + Double($0) * step, elevation: elevation)
      }
    }
    return (0..<options.viewCount).map {
      Direction(azimuth: 2 * .pi * Double($0) / count, elevation: elevation)
    }
  }

  /// The median elevation of the photos, within bounds.
  private func medianElevation(_ viewDirections: [SIMD3<Double>]) -> Double {
    let median = viewDirections.map { asin(min(max($0.y, -1), 1)) }.upperMedian
    let degrees = median.map {
      min(max($0 * 180 / .pi, options.minimumElevationDegrees), options.maximumElevationDegrees)
    }
    return (degrees ?? options.elevationDegrees) * .pi / 180
  }

  /// The photographed side; nil if the photos surround the object or look down at it.
  private func seenSide(_ viewDirections: [SIMD3<Double>]) -> (azimuth: Double, reach: Double)? {
    let flat = viewDirections.map { SIMD2($0.x, $0.z) }
    let sum = flat.reduce(SIMD2<Double>.zero, +)
    let lengths = flat.reduce(0) { $0 + $1.length }
    guard lengths > options.minimumHorizontalShare * Double(flat.count),
      sum.length > options.oneSidedConcentration * lengths
    else { return nil }
    let azimuth = atan2(sum.x, sum.y)
    let offsets = flat.map { abs(remainder(atan2($0.x, $0.y) - azimuth, 2 * .pi)) }.sorted()
    let reach = offsets[Int(options.reachShare * Double(offsets.count - 1))] * 180 / .pi
    let degrees = min(max(reach, options.minimumReachDegrees), options.maximumReachDegrees)
    return (azimuth, degrees * .pi / 180)
  }

  /// The rotation of an upright camera that looks at the model from a direction.
  private static func rotation(_ direction: Direction) -> Quaternion {
    let (a, e) = (direction.azimuth, direction.elevation)
    let forward = -SIMD3(cos(e) * sin(a), sin(e), cos(e) * cos(a))
    let right = forward.cross([0, 1, 0]).normalized
    return Quaternion(Matrix3(rows: right, forward.cross(right), forward))
  }

  /// The minimum distance from the center at which all positions are within the field of view.
  private func leastDistance(
    of positions: [SIMD3<Float>], around center: SIMD3<Double>, _ rotation: Quaternion
  ) -> Double {
    let matrix = rotation.matrix
    let spread = 1 / tan(options.fieldOfViewDegrees * .pi / 360)
    var (distance, radius) = (0.0, 0.0)
    for position in positions {
      let p = SIMD3<Double>(position) - center
      let (x, y, z) = (matrix.row0.dot(p), matrix.row1.dot(p), matrix.row2.dot(p))
      distance = max(distance, max(abs(x), abs(y)) * spread - z)
      radius = max(radius, p.squaredLength)
    }
    // Any closer, a needle that points at the viewer would touch the eye.
    let nearest = 2 * radius.squareRoot()
    return max(distance, nearest > 0 ? nearest : 1)
  }
}
