/// The calibration of a camera.
public final class AVCameraCalibrationData: Sendable {
  /// Focal lengths and principal point in pixels of the reference dimensions, stored by columns.
  public let intrinsicMatrix: simd_float3x3
  /// The size in pixels that `intrinsicMatrix` refers to.
  public let intrinsicMatrixReferenceDimensions: CGSize
  /// The pose relative to the device's main camera: a rotation and a translation in millimeters.
  public let extrinsicMatrix: simd_float4x4
  /// The size of a pixel in millimeters.
  public let pixelSize: Float
  /// The center of the lens distortion, in pixels of the reference dimensions.
  public let lensDistortionCenter: CGPoint
  /// Radial magnifications from the center to the farthest corner, as 32-bit floats.
  public let lensDistortionLookupTable: Data?
  /// The magnifications that invert `lensDistortionLookupTable`.
  public let inverseLensDistortionLookupTable: Data?

  /// Creates a calibration; the distortion tables default to none.
  package init(
    intrinsicMatrix: simd_float3x3, intrinsicMatrixReferenceDimensions: CGSize,
    extrinsicMatrix: simd_float4x4 = matrix_identity_float4x4, pixelSize: Float = 0,
    lensDistortionCenter: CGPoint = .zero, lensDistortionLookupTable: Data? = nil,
    inverseLensDistortionLookupTable: Data? = nil
  ) {
    self.intrinsicMatrix = intrinsicMatrix
    self.intrinsicMatrixReferenceDimensions = intrinsicMatrixReferenceDimensions
    self.extrinsicMatrix = extrinsicMatrix
    self.pixelSize = pixelSize
    self.lensDistortionCenter = lensDistortionCenter
    self.lensDistortionLookupTable = lensDistortionLookupTable
    self.inverseLensDistortionLookupTable = inverseLensDistortionLookupTable
  }
}
