import Foundation
import SceneModel

/// Detects the dominant near-horizontal plane under the object by RANSAC (Fischler and Bolles, CACM
/// 1981) with least-squares refinement.
struct SupportPlaneDetection {
  struct Options: Hashable, Codable, Sendable {
    /// Planes steeper than this are walls, in degrees. Chosen.
    var maximumTiltDegrees = 30.0
    /// The same if the up direction is only estimated from the photos. Chosen.
    var maximumUnknownTiltDegrees = 60.0
    /// Number of RANSAC hypotheses. Chosen.
    var iterations = 800
    /// Number of samples that score a hypothesis. Chosen.
    var scoringSamples = 4000
    /// Inlier threshold: half the thickness of the plane, as a share of the camera distance.
    /// Measured: tuned on the sets marked so in Benchmarks/sets.json.
    var tolerance = 0.006
    /// Share of the samples that must lie on the plane. Measured: as above.
    var minimumShare = 0.08
    /// A plane is the top of a body with side faces if there are more samples below it than this
    /// share of those on it. Chosen.
    var maximumBelow = 0.35
    /// A plane surrounds what is above it if it has samples in at least this number of sectors, out
    /// of `sectorCount`. Chosen.
    var minimumSectors = 9
    var sectorCount = 12
    /// Share of the cameras that must be above the plane. Chosen.
    var minimumCamerasAbove = 0.8
    /// How far, in the cosine, a sample's normal may be steeper than the steepest plane. Chosen.
    var normalTolerance = 0.1
    /// Minimum number of samples that a plane is fitted to. Chosen.
    var minimumSamples = 12
    /// Minimum of the inlier threshold in sample spacings. Chosen.
    var minimumToleranceCells = 2.0
    /// Number of fits to the inliers of the best hypothesis. Chosen.
    var refinements = 4
    /// Minimum cosine of the angle between the normals of an inlier and of the plane in a fit.
    /// Chosen.
    var minimumNormalCosine = 0.7
    /// Band of the plane in standard deviations of its inliers, and its minimum in sample spacings.
    /// Chosen.
    var bandDeviations = 3.5
    var minimumBandCells = 1.0
    var seed: UInt64 = 0x5eed_0001

    init() {}
  }

  var options = Options()

  /// Nil if no plane has enough support. `positions` and `normals` (may be empty) are of evenly
  /// spaced samples in the region that the photos cover; `cell` is their spacing in world units.
  func run(
    positions: [SIMD3<Float>], normals: [SIMD3<Float>], up: SIMD3<Double>, isUpKnown: Bool,
    focus: ViewFocus, cell: Double
  ) -> SupportPlane? {
    let tilt = isUpKnown ? options.maximumTiltDegrees : options.maximumUnknownTiltDegrees
    let minimumCosine = cos(tilt * .pi / 180)
    let candidates = positions.indices.filter { index in
      normals.isEmpty
        || SIMD3<Double>(normals[index]).dot(up) > minimumCosine - options.normalTolerance
    }
    guard candidates.count >= options.minimumSamples else { return nil }
    let tolerance = max(
      options.minimumToleranceCells * cell, options.tolerance * focus.distance)
    let stride = max(1, positions.count / options.scoringSamples)
    let scoring = Swift.stride(from: 0, to: positions.count, by: stride).map {
      SIMD3<Double>(positions[$0])
    }
    var random = SplitMix64(seed: options.seed)
    var best: (plane: SupportPlane, score: Double)?
    for _ in 0..<options.iterations {
      let corners = (0..<3).map { _ in
        SIMD3<Double>(positions[candidates[random.below(candidates.count)]])
      }
      guard var plane = SupportPlane(through: corners, up: up, band: tolerance),
        plane.normal.dot(up) > minimumCosine, camerasAbove(plane, focus)
      else { continue }
      plane.band = tolerance
      let score = score(plane, scoring)
      if score > (best?.score ?? 0) { best = (plane, score) }
    }
    guard var plane = best?.plane else { return nil }
    for _ in 0..<options.refinements {
      plane = refined(plane, positions, normals, up, tolerance, cell) ?? plane
    }
    let share = positions.reduce(0) {
      abs(plane.height(of: SIMD3<Double>($1))) < tolerance ? $0 + 1 : $0
    }
    guard Double(share) >= options.minimumShare * Double(positions.count) else { return nil }
    return plane
  }

  /// Inliers of the plane, minus samples below it: nothing is visible under a support.
  private func score(_ plane: SupportPlane, _ samples: [SIMD3<Double>]) -> Double {
    samples.reduce(0) { sum, sample in
      let height = plane.height(of: sample)
      if abs(height) < plane.band { return sum + 1 - abs(height) / plane.band * 0.5 }
      return height < -3 * plane.band ? sum - 0.5 : sum
    }
  }

  /// Whether enough cameras are above the plane.
  private func camerasAbove(_ plane: SupportPlane, _ focus: ViewFocus) -> Bool {
    let centers = focus.centers
    let above = centers.filter { plane.height(of: $0) > 0 }.count
    return Double(above) >= options.minimumCamerasAbove * Double(centers.count)
  }

  /// The least-squares plane through the inliers, with a band from their deviation (1.4826 · MAD).
  private func refined(
    _ plane: SupportPlane, _ positions: [SIMD3<Float>], _ normals: [SIMD3<Float>],
    _ up: SIMD3<Double>, _ tolerance: Double, _ cell: Double
  ) -> SupportPlane? {
    let inliers = positions.indices.filter { index in
      abs(plane.height(of: SIMD3<Double>(positions[index]))) < tolerance
        && (normals.isEmpty
          || SIMD3<Double>(normals[index]).dot(plane.normal)
            > options.minimumNormalCosine)
    }.map { SIMD3<Double>(positions[$0]) }
    guard inliers.count >= options.minimumSamples,
      var result = SupportPlane(fitting: inliers, near: plane)
    else { return nil }
    let deviation = 1.4826 * (inliers.map { abs(result.height(of: $0)) }.upperMedian ?? 0)
    result.band = min(
      tolerance, max(options.bandDeviations * deviation, options.minimumBandCells * cell))
    return result
  }
}

// MARK: - Faces of the object

extension SupportPlaneDetection {
  /// Samples that a plane divides.
  struct Division {
    /// Samples on the plane with its normal.
    var level: [SIMD3<Double>] = []
    var above: [SIMD3<Double>] = []
    var below: [SIMD3<Double>] = []
  }

  /// Divides samples; `cell` is their spacing.
  func divide(
    _ positions: [SIMD3<Float>], _ normals: [SIMD3<Float>], by plane: SupportPlane,
    focus: ViewFocus, cell: Double
  ) -> Division {
    let tolerance = max(options.minimumToleranceCells * cell, options.tolerance * focus.distance)
    var result = Division()
    for (index, position) in positions.enumerated() {
      let position = SIMD3<Double>(position)
      let height = plane.height(of: position)
      if height > tolerance {
        result.above.append(position)
      } else if height < -tolerance {
        result.below.append(position)
      } else if normals.isEmpty
        || SIMD3<Double>(normals[index]).dot(plane.normal) > options.minimumNormalCosine
      {
        result.level.append(position)
      }
    }
    return result
  }

  /// Whether much is visible below the plane, which a table would hide: it is the top of a plinth,
  /// whose side faces are visible.
  func hasSideFaces(_ division: Division) -> Bool {
    Double(division.below.count) > options.maximumBelow * Double(division.level.count)
  }

  /// Whether the plane surrounds what is above it, as a turntable does.
  func surrounds(_ plane: SupportPlane, _ division: Division) -> Bool {
    guard !division.above.isEmpty else { return false }
    let middle = division.above.reduce(.zero, +) / Double(division.above.count)
    let axis: SIMD3<Double> = abs(plane.normal.x) < 0.9 ? [1, 0, 0] : [0, 1, 0]
    let across = axis.cross(plane.normal).normalized
    let along = plane.normal.cross(across)
    var counts = [Int](repeating: 0, count: options.sectorCount)
    for position in division.level {
      let offset = position - middle
      let turn = atan2(offset.dot(along), offset.dot(across)) / (2 * .pi) + 0.5
      counts[min(options.sectorCount - 1, Int(turn * Double(options.sectorCount)))] += 1
    }
    // Sectors with a quarter of an even share.
    let needed = division.level.count / (4 * options.sectorCount)
    return counts.count { $0 > needed } >= options.minimumSectors
  }
}

extension SupportPlane {
  /// The level plane through the lowest points of an object; nil if the up direction isn't known,
  /// or if photos show the underside, which then requires no plane to be filled.
  init?(under object: PointCloud, in frame: WorldFrame) {
    let up = SIMD3<Float>(frame.vertical)
    let heights = object.positions.map { Double(($0 * up).sum()) }
    guard frame.up != .unknown, object.normals.count == object.count,
      let footprint = object.medianFootprint, let low = heights.quantile(0.002),
      let high = heights.quantile(0.998),
      // A flat object has no part that is clearly the lowest.
      high - low > 20 * Double(footprint)
    else { return nil }
    // The underside is visible if a tenth of the lowest part faces down.
    let lowest = heights.indices.filter { heights[$0] < low + 0.15 * (high - low) }
    let facingDown = lowest.count { (object.normals[$0] * up).sum() < -0.7 }
    guard 10 * facingDown < lowest.count else { return nil }
    self.init(normal: frame.vertical, offset: low, band: 2 * Double(footprint))
  }
}
