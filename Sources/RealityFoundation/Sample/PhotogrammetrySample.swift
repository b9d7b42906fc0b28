/// A photo in memory with what is known about it.
public struct PhotogrammetrySample: Identifiable {
  /// The number of the sample, from 0 to 2147483647, different for each sample of a session.
  public let id: Int
  /// The pixels, 32BGRA or 32ARGB.
  public let image: CVPixelBuffer
  /// EXIF and other properties as image readers give them.
  public var metadata: [String: Any] = [:]
  /// Depths in metres along the optical axis, or disparities in 1/metre, of the image's field of view:
  /// DepthFloat32, DisparityFloat32 or those of 16 bits. They give the model its size.
  public var depthDataMap: CVPixelBuffer?
  /// The direction of gravity in the device's frame, as a phone's motion sensors tell it: x to the
  /// right and y up on the screen, z towards the user. It says what is up in the model.
  public var gravity: CMAcceleration?
  /// Where the object is, OneComponent8 of the image's size; zero is not part of it.
  public var objectMask: CVPixelBuffer?

  /// When the photo was taken.
  public internal(set) var captureTime: Date?
  /// The transform of the unit cube to the box around the object.
  public internal(set) var boundingBox: simd_float4x4?
  /// How far each depth can be trusted.
  public internal(set) var depthConfidenceMap: CVPixelBuffer?
  /// The camera that took the photo.
  public internal(set) var camera: Camera?
  /// The capture session that the photo belongs to.
  public internal(set) var sessionID: UUID?
  /// The pass around the object that the photo belongs to.
  public internal(set) var scanPassID: Int?
  /// How the pixels are to be turned to stand upright.
  public internal(set) var orientation = CGImagePropertyOrientation.up

  /// Creates a sample from its pixels.
  public init(id: Int, image: CVPixelBuffer) {
    self.id = id
    self.image = image
  }

  /// The camera of a sample.
  public struct Camera {
    /// The number of the camera.
    public var id: UInt32
    /// Focal lengths and principal point in pixels, by columns.
    public var intrinsics: simd_float3x3
    /// The camera's pose in the capture session.
    public var transform: simd_float4x4
    /// More about the optics.
    public var calibrationData: AVCameraCalibrationData?
  }
}

extension PhotogrammetrySample: CustomStringConvertible {
  /// The number and size of the sample.
  public var description: String {
    let extras = [
      depthDataMap.map { _ in "depth" }, gravity.map { _ in "gravity" },
      objectMask.map { _ in "mask" },
    ].compactMap { $0 }
    let suffix = extras.isEmpty ? "" : ", " + extras.joined(separator: ", ")
    return "PhotogrammetrySample(id: \(id), \(image.width)×\(image.height)\(suffix))"
  }
}
