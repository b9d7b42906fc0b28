/// An observation of one triangle in one view.
package struct FaceObservation: Hashable, Sendable {
  /// Index of the triangle.
  package var face: Int32
  /// Index of the view, set by the caller.
  package var view: Int32 = 0
  /// Projected area in pixels.
  package var area: Float
  /// Cosine of the angle between the triangle's normal and the direction to the camera.
  package var cosine: Float
  /// Mean magnitude of the luminance gradient, in gray levels per pixel.
  package var gradient: Float
  /// Whether no occluding edge is close to the triangle in the image.
  package var isClear: Bool
  /// Whether the surface continues around the triangle in the image.
  package var isInterior: Bool
  /// Mean RGB, 0…255.
  package var color: SIMD3<Float>

  package init(
    face: Int32, view: Int32 = 0, area: Float, cosine: Float, gradient: Float,
    isClear: Bool = true, isInterior: Bool = true, color: SIMD3<Float>
  ) {
    self.face = face
    self.view = view
    self.area = area
    self.cosine = cosine
    self.gradient = gradient
    self.isClear = isClear
    self.isInterior = isInterior
    self.color = color
  }
}
