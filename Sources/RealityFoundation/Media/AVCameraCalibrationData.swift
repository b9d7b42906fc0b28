/// What is known about a camera's optics.
public final class AVCameraCalibrationData: Sendable {
  /// Focal lengths and principal point in pixels of the reference dimensions, by columns.
  public let intrinsicMatrix: simd_float3x3
  /// The size in pixels that `intrinsicMatrix` refers to.
  public let intrinsicMatrixReferenceDimensions: CGSize
  /// The camera's place relative to the device's main camera: a rotation and a shift in millimetres.
  public let extrinsicMatrix: simd_float4x4
  /// The size of a pixel in millimetres.
  public let pixelSize: Float
  /// Where the lens distortion is centred, in pixels of the reference dimensions.
  public let lensDistortionCenter: CGPoint
  /// Radial magnifications from the centre to the farthest corner, as 32-bit floats.
  public let lensDistortionLookupTable: Data?
  /// The magnifications that undo `lensDistortionLookupTable`.
  public let inverseLensDistortionLookupTable: Data?

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
