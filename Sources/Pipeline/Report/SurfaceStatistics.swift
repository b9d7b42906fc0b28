import Kernels
import SceneModel

/// How the photos show a model, by area.
package struct SurfaceStatistics: Hashable, Codable, Sendable {
  package var triangles: Int
  package var vertices: Int
  /// The share of the area by number of photos that show it; the last one is that of all larger
  /// numbers, too.
  package var photosHistogram: [Double]
  /// The share of the area that no photo colors: it was closed by guess.
  package var closedShare: Double
  /// How much of the object's outline in the photos the model fills, median of the photos, 0…1; nil
  /// without masks.
  package var outlineShare: Double?
  /// The share of the area that more photos from reachable places would show, as the advice says;
  /// nil without masks.
  package var missingShare: Double?
  /// The root mean square difference between photos at the same place, 0…255, median by area; nil
  /// if no place is shown by two photos.
  package var medianPhotometricResidual: Double?
  /// The standard deviation across the surface of a point that photos locate as precisely as the
  /// sparse points, in world units, median by area; nil if no place is shown by two photos.
  package var medianUncertainty: Double?
}

extension SurfaceStatistics {
  /// `residual` is the mean reprojection error in pixels.
  init(_ evidence: ModelEvidence, residual: Double) {
    let areas = evidence.mesh.triangleAreas().map(Double.init)
    let total = max(areas.reduce(0, +), .leastNormalMagnitude)
    triangles = evidence.faces.count
    vertices = evidence.mesh.positions.count
    photosHistogram = [Double](
      repeating: 0, count: Int(evidence.faces.map(\.photoCount).max() ?? 0) + 1)
    closedShare = 0
    for (index, face) in evidence.faces.enumerated() {
      photosHistogram[Int(face.photoCount)] += areas[index] / total
      if evidence.painters[index] == nil { closedShare += areas[index] / total }
    }
    medianPhotometricResidual = Self.median(evidence.faces.map(\.photometricResidual), areas)
    medianUncertainty = Self.median(evidence.faces.map(\.uncertainty), areas).map { $0 * residual }
  }

  /// The median of finite values by weight; nil if there are none.
  private static func median(_ values: [Float], _ weights: [Double]) -> Double? {
    let order = values.indices.filter { values[$0].isFinite }.sorted { values[$0] < values[$1] }
    let half = order.reduce(0) { $0 + weights[$1] } / 2
    var sum = 0.0
    for index in order {
      sum += weights[index]
      if sum >= half { return Double(values[index]) }
    }
    return nil
  }

  /// The share of the area that at least `count` photos show.
  package func share(shownBy count: Int) -> Double {
    photosHistogram.dropFirst(count).reduce(0, +)
  }
}
