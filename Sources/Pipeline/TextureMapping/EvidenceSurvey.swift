import Foundation
import Kernels
import SceneModel

/// Measures how the photos show each triangle: by how many, how equally, and how well the
/// intersection of their rays determines its position.
struct EvidenceSurvey {
  /// By view.
  let centers: [SIMD3<Double>]
  /// Mean focal lengths in pixels, by view.
  let focalLengths: [Double]
  let gains: [ExposureGain]

  /// The smallest cosine at which a photo counts: that of 75°. Measured: on rendered sets (dense5,
  /// orbit, `captures` with arcs left out), it separates complete from incomplete ones best of 65°
  /// to 81°.
  static let minimumCosine: Float = 0.25

  /// `gains` are those of the registered photos.
  init(_ reconstruction: Reconstruction, gains: [ExposureGain]) {
    let views = reconstruction.registered
    centers = views.map { reconstruction.poses[$0.index]?.center ?? .zero }
    focalLengths = views.map { reconstruction.camera(of: $0).focalLength.sum() / 2 }
    self.gains = gains
  }

  /// The figures of all triangles.
  func run(
    _ mesh: Mesh, seen: FaceViews, _ control: KernelControl
  ) throws -> [ModelEvidence.Face] {
    try control.parallelMap(seen.blocks.count) { number in
      let block = seen.blocks[number]
      return (0..<block.faceCount).map { face in
        let triangle = mesh.triangles[number * FaceBlocks.size + face]
        return self.face(mesh, triangle, block.entries[block.range(of: face)])
      }
    }.flatMap(\.self)
  }

  private func face(
    _ mesh: Mesh, _ triangle: Triangle, _ entries: ArraySlice<FaceObservation>
  ) -> ModelEvidence.Face {
    ModelEvidence.Face(
      photoCount: UInt8(clamping: entries.count { $0.cosine >= Self.minimumCosine }),
      photometricResidual: photometricResidual(entries),
      uncertainty: uncertainty(
        at: SIMD3<Double>(mesh.center(of: triangle)),
        normal: SIMD3<Double>(mesh.scaledNormal(of: triangle)).normalized, entries))
  }

  private func photometricResidual(_ entries: ArraySlice<FaceObservation>) -> Float {
    guard entries.count >= 2 else { return .nan }
    let count = Float(entries.count)
    var (sum, squares) = (SIMD3<Float>.zero, SIMD3<Float>.zero)
    for entry in entries {
      let color = gains[Int(entry.view)].apply(entry.color)
      sum += color
      squares += color * color
    }
    let variance = squares / count - (sum / count) * (sum / count)
    return max(0, variance.sum() / 3).squareRoot()
  }

  /// The square root of nᵀ A⁻¹ n: A is the information of the rays, each of which locates the point
  /// to one pixel across its direction d, A = Σ (f / r)² (I − d dᵀ) (Förstner and Wrobel,
  /// "Photogrammetric Computer Vision", 2016, section 13.4).
  private func uncertainty(
    at point: SIMD3<Double>, normal: SIMD3<Double>, _ entries: ArraySlice<FaceObservation>
  ) -> Float {
    guard entries.count >= 2 else { return .nan }
    var (rows, total) = ([SIMD3<Double>](repeating: .zero, count: 3), 0.0)
    for entry in entries {
      let way = point - centers[Int(entry.view)]
      let direction = way.normalized
      let weight =
        focalLengths[Int(entry.view)] * focalLengths[Int(entry.view)]
        / max(way.squaredLength, .leastNormalMagnitude)
      total += weight
      for axis in 0..<3 {
        rows[axis] -= weight * direction[axis] * direction
        rows[axis][axis] += weight
      }
    }
    let information = Matrix3(rows: rows[0] / total, rows[1] / total, rows[2] / total)
    // Parallel rays, to the precision of the poses: the distance is not determined.
    guard information.determinant > 1e-9, let solution = information.solution(of: normal) else {
      return .nan
    }
    return Float((max(0, normal.dot(solution)) / total).squareRoot())
  }
}
