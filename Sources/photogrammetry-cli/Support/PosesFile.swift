import Foundation
import RealityKit

/// The content of `--poses`: where the cameras stood, in the model's frame.
struct PosesFile: Encodable {
  struct Entry: Encodable {
    /// The session's number of the photo.
    var id: Int
    var name: String
    /// The camera's centre.
    var translation: [Float]
    /// Camera to world, as a quaternion x, y, z, w.
    var rotation: [Float]
    /// Pixels of the upright photo; missing where the engine does not tell.
    var intrinsics: Intrinsics?
  }

  struct Intrinsics: Encodable {
    var focalLength: [Float]
    var principalPoint: [Float]
  }

  var convention = "camera to world; the camera looks along -z, its y axis is up"
  var photos: [Entry]

  init(_ poses: PhotogrammetrySession.Poses) {
    photos = poses.posesBySample.keys.sorted().compactMap { id in
      guard let pose = poses.posesBySample[id] else { return nil }
      let (t, q) = (pose.translation, pose.rotation.vector)
      return Entry(
        id: id, name: poses.urlsBySample[id]?.lastPathComponent ?? "\(id)",
        translation: [t.x, t.y, t.z], rotation: [q.x, q.y, q.z, q.w],
        intrinsics: engineIntrinsics(of: pose))
    }
  }

  /// The file's content.
  func encoded() throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    return try encoder.encode(self) + Data("\n".utf8)
  }
}
