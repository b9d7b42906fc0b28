import Kernels
import SceneModel

/// How the photos show each triangle of a model, for the report of a run and its advice.
package struct ModelEvidence: Sendable {
  /// The figures of a triangle.
  package struct Face: Hashable, Sendable {
    /// Number of photos that show the triangle at less than 75° from its normal, at most
    /// `ViewObservation.Options.maximumViews`.
    package var photoCount: UInt8 = 0
    /// Root mean square difference between the photos' colors at equal exposure and their mean,
    /// 0…255; NaN if fewer than two photos show the triangle.
    package var photometricResidual: Float = .nan
    /// Standard deviation across the surface of a point that each photo locates to one pixel, in
    /// world units; NaN if the photos don't determine it.
    package var uncertainty: Float = .nan
  }

  /// The textured surface; its triangles are in the order of `faces`.
  package var mesh: Mesh
  /// `mesh`, for casting rays.
  package var scene: RayScene
  package var faces: [Face]
  /// The photo that colors each triangle most; nil if no photo shows it.
  package var painters: [ID<Photo>?]
  /// The gain, of light, that brings each registered photo to the mean exposure, by photo ID.
  package var gains: [ID<Photo>: Float]
}

extension ModelEvidence {
  /// The share of the area that each photo colors more than any other.
  var areaShares: [ID<Photo>: Double] {
    let areas = mesh.triangleAreas()
    let total = max(areas.reduce(0) { $0 + Double($1) }, .leastNormalMagnitude)
    var result: [ID<Photo>: Double] = [:]
    for (painter, area) in zip(painters, areas) {
      if let painter { result[painter, default: 0] += Double(area) / total }
    }
    return result
  }
}
