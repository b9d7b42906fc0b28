/// A radial lens distortion as a lookup table.
public struct LensDistortionData: Sendable {
  /// The center of the distortion in pixels.
  public let center: SIMD2<Float>
  /// Relative displacements by radius, at equal steps from the center to the farthest corner.
  ///
  /// A point at an undistorted radius r is imaged at r · (1 + value).
  public let radialLookupTable: [Float]

  /// Creates a distortion from its center and table.
  public init(center: SIMD2<Float>, radialLookupTable: [Float]) {
    self.center = center
    self.radialLookupTable = radialLookupTable
  }
}
