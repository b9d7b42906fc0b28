import Foundation

/// The content of `--poses`: camera poses in the model's frame.
package struct PosesFile: Encodable {
  struct Entry: Encodable {
    /// Index of the photo in the session.
    var id: Int
    /// The file name of the photo; the index if it has none.
    var name: String
    /// The camera's center in the model's frame.
    var translation: [Float]
    /// Camera to world, as a quaternion x, y, z, w.
    var rotation: [Float]
    /// Pixels of the upright photo; missing if the engine does not provide them.
    var intrinsics: Intrinsics?
  }

  /// Focal lengths and principal point in x and y, in pixels.
  package struct Intrinsics: Encodable {
    var focalLength: [Float]
    var principalPoint: [Float]

    /// Creates intrinsics from values in x and y, in pixels.
    package init(focalLength: [Float], principalPoint: [Float]) {
      (self.focalLength, self.principalPoint) = (focalLength, principalPoint)
    }
  }

  var convention = "camera to world; the camera looks along -z, its y axis is up"
  var photos: [Entry]

  /// Sorts poses by photo; `intrinsics` are those of the photo's camera.
  init(
    _ poses: PhotogrammetrySession.Poses,
    intrinsics: (PhotogrammetrySession.Pose) -> Intrinsics?
  ) {
    photos = poses.posesBySample.keys.sorted().compactMap { id in
      guard let pose = poses.posesBySample[id] else { return nil }
      let (t, q) = (pose.translation, pose.rotation.vector)
      return Entry(
        id: id, name: poses.urlsBySample[id]?.lastPathComponent ?? "\(id)",
        translation: [t.x, t.y, t.z], rotation: [q.x, q.y, q.z, q.w],
        intrinsics: intrinsics(pose))
    }
  }

  /// The file's content.
  func encoded() throws -> Data {
    try JSONEncoder.readable.encode(self) + Data("\n".utf8)
  }
}
