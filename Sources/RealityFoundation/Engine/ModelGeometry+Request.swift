import SceneModel

extension ModelGeometry {
  /// The geometry of a request: bounds in the frame of `Request.bounds`, and a transform of the
  /// cropped model.
  package init(_ geometry: PhotogrammetrySession.Request.Geometry) {
    let matrix = geometry.transform.matrix
    func column(_ index: Int) -> SIMD3<Float> {
      SIMD3(matrix[index].x, matrix[index].y, matrix[index].z)
    }
    self.init(
      crop: OrientedBox(geometry.orientedBounds),
      transform: geometry.transform == .identity
        ? .identity
        : AffineMap(x: column(0), y: column(1), z: column(2), translation: column(3)))
  }
}

extension OrientedBox {
  /// The crop box of a request; nil for an empty one, which keeps everything.
  init?(_ box: OrientedBoundingBox) {
    guard !box.boundingBox.isEmpty else { return nil }
    let q = box.orientation.vector
    // Some programs use the largest finite numbers for unbounded sides.
    let far = SIMD3<Float>(repeating: 1e6)
    let low = box.boundingBox.min.clamped(lowerBound: -far, upperBound: far)
    let high = box.boundingBox.max.clamped(lowerBound: -far, upperBound: far)
    self.init(
      center: (low + high) / 2, halfExtents: (high - low) / 2,
      rotation: Quaternion(x: Double(q.x), y: Double(q.y), z: Double(q.z), w: Double(q.w))
        .normalized)
  }
}
