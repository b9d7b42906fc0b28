extension PhotogrammetrySession {
  /// Where and how a camera stood: camera to world, the camera looking along −z with y up.
  public struct Pose: Sendable {
    /// The camera's centre.
    public let translation: SIMD3<Float>
    /// The rotation from the camera's frame to the model's.
    public let rotation: simd_quatf
    /// Focal lengths and principal point in pixels of the upright photo, by columns.
    public let intrinsics: simd_float3x3?
    /// The lens distortion.
    public let lensDistortionData: LensDistortionData?

    /// The pose as a transform of unit scale.
    public var transform: Transform {
      Transform(
        scale: SIMD3(repeating: 1), rotation: rotation, translation: translation)
    }
  }

  /// The poses of all photos that were placed.
  public struct Poses: Sendable {
    /// The poses by sample id.
    public let posesBySample: [Int: Pose]
    /// The photos' files by sample id; empty unless the input was a folder.
    public let urlsBySample: [Int: URL]
  }
}
