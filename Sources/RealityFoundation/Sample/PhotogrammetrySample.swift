/// A photo in memory with its metadata.
public struct PhotogrammetrySample: Identifiable {
  /// The identifier of the sample, 0…2147483647, unique within a session.
  public let id: Int
  /// The pixels, 32BGRA or 32ARGB.
  public let image: CVPixelBuffer
  /// EXIF and other image properties with ImageIO's keys.
  public var metadata: [String: Any] = [:]
  /// Depths in meters along the optical axis, or disparities in 1/meter, with the image's field of
  /// view: DepthFloat32, DisparityFloat32 or their 16-bit variants. They determine the scale of the
  /// model.
  public var depthDataMap: CVPixelBuffer?
  /// The direction of gravity in the device's frame, as a phone's motion sensors report it: x to
  /// the right and y up on the screen, z toward the user. It determines the up direction of the
  /// model.
  public var gravity: CMAcceleration?
  /// The mask of the object, OneComponent8 of the image's size; zero means background.
  public var objectMask: CVPixelBuffer?

  /// When the photo was taken; nil unless the sample was loaded from a file that has the time.
  public internal(set) var captureTime: Date?
  /// The transform from the unit cube to the bounding box of the object; always nil here.
  public internal(set) var boundingBox: simd_float4x4?
  /// The confidence of each depth; always nil here.
  public internal(set) var depthConfidenceMap: CVPixelBuffer?
  /// The camera that took the photo; always nil here.
  public internal(set) var camera: Camera?
  /// The capture session that the photo belongs to; always nil here.
  public internal(set) var sessionID: UUID?
  /// The scan pass around the object that the photo belongs to; always nil here.
  public internal(set) var scanPassID: Int?
  /// The EXIF orientation of the stored pixels.
  public internal(set) var orientation = CGImagePropertyOrientation.up

  /// Creates a sample from its pixels.
  public init(id: Int, image: CVPixelBuffer) {
    self.id = id
    self.image = image
  }

  /// The camera of a sample.
  public struct Camera {
    /// The identifier of the camera.
    public var id: UInt32
    /// Focal lengths and principal point in pixels, stored by columns.
    public var intrinsics: simd_float3x3
    /// The camera's pose in the capture session.
    public var transform: simd_float4x4
    /// The calibration of the optics.
    public var calibrationData: AVCameraCalibrationData?
  }
}

extension PhotogrammetrySample: CustomStringConvertible {
  /// The identifier, size and auxiliary data of the sample.
  public var description: String {
    let extras = [
      depthDataMap.map { _ in "depth" }, gravity.map { _ in "gravity" },
      objectMask.map { _ in "mask" },
    ].compactMap { $0 }
    let suffix = extras.isEmpty ? "" : ", " + extras.joined(separator: ", ")
    return "PhotogrammetrySample(id: \(id), \(image.width)×\(image.height)\(suffix))"
  }
}
