extension PhotogrammetrySession {
  /// A camera pose: camera to world; the camera looks along −z with y up.
  public struct Pose: Sendable {
    /// The camera center in the model's frame.
    public let translation: SIMD3<Float>
    /// The rotation from the camera frame to the model's frame.
    public let rotation: simd_quatf
    /// Focal lengths and principal point in pixels of the upright photo, stored by columns.
    public let intrinsics: simd_float3x3?
    /// The lens distortion.
    public let lensDistortionData: LensDistortionData?

    /// The pose as a transform of unit scale.
    public var transform: Transform {
      Transform(
        scale: SIMD3(repeating: 1), rotation: rotation, translation: translation)
    }
  }

  /// The poses of all registered photos.
  public struct Poses: Sendable {
    /// The poses by sample id.
    public let posesBySample: [Int: Pose]
    /// The URLs of the photos by sample id; empty unless the input was a folder.
    public let urlsBySample: [Int: URL]
  }
}
