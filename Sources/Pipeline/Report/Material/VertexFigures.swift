import Kernels
import SceneModel

/// A figure at each vertex of a model, for a heat map.
package struct VertexFigures: Sendable {
  package enum Kind: String, Encodable, Sendable {
    case photos, reprojection, photometric, uncertainty, closed, distance
  }

  package var kind: Kind
  package var name: String
  package var unit: String
  /// NaN where there is none.
  package var values: [Float]
  /// What the end of the scale stands for; larger values have its color.
  package var high: Float

  /// The scale ends at the value that 98 % don't exceed, unless it is given.
  package init(
    _ kind: Kind, _ name: String, _ unit: String, _ values: [Float], high: Float? = nil
  ) {
    (self.kind, self.name, self.unit, self.values) = (kind, name, unit, values)
    self.high = high ?? values.filter(\.isFinite).quantile(0.98) ?? 1
    if !(self.high > 0) { self.high = 1 }
  }
}

extension VertexFigures {
  /// All figures of a model.
  static func all(
    _ evidence: ModelEvidence, _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws -> [VertexFigures] {
    let faces = evidence.faces
    let residual = Float(reconstruction.meanReprojectionError)
    let length = lengthUnit(of: evidence.mesh, reconstruction.worldFrame)
    func mean(_ value: (Int) -> Float) -> [Float] { evidence.mesh.vertexMeans(value) }
    return [
      VertexFigures(
        .photos, "Photos that show the surface", "photos", mean { Float(faces[$0].photoCount) },
        high: 12),
      VertexFigures(
        .reprojection, "Reprojection error of the nearest sparse points", "px",
        try reprojection(evidence.mesh, reconstruction, control)),
      VertexFigures(
        .photometric, "Difference between photos", "of 255",
        mean { faces[$0].photometricResidual }),
      VertexFigures(
        .uncertainty, "Uncertainty across the surface", length.name,
        mean { faces[$0].uncertainty * residual * length.scale }),
      VertexFigures(
        .closed, "Closed by guess: no photo shows it", "share",
        mean { evidence.painters[$0] == nil ? 1 : 0 }, high: 1),
    ]
  }

  /// Millimeters, or thousandths of the model's size if its scale is arbitrary.
  private static func lengthUnit(
    of mesh: Mesh, _ frame: WorldFrame
  ) -> (name: String, scale: Float) {
    if frame.scale.isMetric { return ("mm", 1000) }
    let bounds = mesh.bounds ?? (.zero, .one)
    return ("‰ of the size", 1000 / max((bounds.max - bounds.min).length, .leastNormalMagnitude))
  }

  /// The mean error of the nearest sparse points within a twentieth of the model's size: chosen, so
  /// that few places have none.
  private static func reprojection(
    _ mesh: Mesh, _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws -> [Float] {
    let points = reconstruction.points
    let bounds = mesh.bounds ?? (.zero, .one)
    let nearest = try NearestPoints(
      of: mesh.positions, in: points.map { SIMD3<Float>($0.position) }, neighbors: 3,
      maximumDistance: Double(max((bounds.max - bounds.min).length, .leastNormalMagnitude)) / 20,
      control)
    return mesh.positions.indices.map { vertex in
      let errors = nearest.indices[3 * vertex..<3 * vertex + 3].filter { $0 >= 0 }
        .map { Float(points[Int($0)].error) }
      return errors.isEmpty ? .nan : errors.reduce(0, +) / Float(errors.count)
    }
  }

  /// One byte per value: 0…254 for 0…`high`, 255 where there is none.
  var bytes: [UInt8] {
    values.map { value in
      value.isFinite ? UInt8(min(max(value / high, 0), 1) * 254 + 0.5) : 255
    }
  }
}

extension Mesh {
  /// The means of the triangles' finite values at the vertices; NaN where there are none.
  fileprivate func vertexMeans(_ value: (Int) -> Float) -> [Float] {
    var sums = [SIMD2<Float>](repeating: .zero, count: positions.count)
    for (face, triangle) in triangles.enumerated() {
      let value = value(face)
      guard value.isFinite else { continue }
      for vertex in triangle.vertices { sums[vertex] += [value, 1] }
    }
    return sums.map { $0.y > 0 ? $0.x / $0.y : .nan }
  }
}
