/// How a view sees a triangle completely. Compact: there are millions.
package struct FaceObservation: Hashable, Sendable {
  /// Index of the triangle.
  package var face: Int32
  /// Projected area in pixels.
  package var area: Float
  /// Cosine of the angle between the triangle's normal and the direction to the camera.
  package var cosine: Float
  /// Mean magnitude of the luminance gradient, in gray levels per pixel.
  package var gradient: Float
  /// A vector of three would take the memory of four.
  private var red: Float
  private var green: Float
  private var blue: Float
  /// The view times 4, plus `Self.clear` and `Self.interior`.
  private var viewAndFlags: Int32

  private static let clear: Int32 = 1
  private static let interior: Int32 = 2

  package init(
    face: Int32, view: Int32 = 0, area: Float, cosine: Float, gradient: Float,
    isClear: Bool = true, isInterior: Bool = true, color: SIMD3<Float>
  ) {
    self.face = face
    self.area = area
    self.cosine = cosine
    self.gradient = gradient
    (red, green, blue) = (color.x, color.y, color.z)
    viewAndFlags = view << 2 | (isClear ? Self.clear : 0) | (isInterior ? Self.interior : 0)
  }

  /// Index of the view, below 2²⁹; set by the caller.
  package var view: Int32 {
    get { viewAndFlags >> 2 }
    set { viewAndFlags = newValue << 2 | viewAndFlags & (Self.clear | Self.interior) }
  }

  /// Whether no occluding edge is close to the triangle in the image.
  package var isClear: Bool { viewAndFlags & Self.clear != 0 }

  /// Whether the surface continues around the triangle in the image.
  package var isInterior: Bool { viewAndFlags & Self.interior != 0 }

  /// Mean RGB, 0…255.
  package var color: SIMD3<Float> {
    get { SIMD3(red, green, blue) }
    set { (red, green, blue) = (newValue.x, newValue.y, newValue.z) }
  }
}
