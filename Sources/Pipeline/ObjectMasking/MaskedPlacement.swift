import Kernels
import SceneModel

/// Photos between which the object was not moved, aligned by themselves, with their masks.
struct MaskedPlacement: Sendable {
  let photos: [Int]
  /// The poses by photo ID, in a frame of this placement.
  let poses: [RigidTransform?]
  let masks: ObjectMasking.Result

  /// What the photos say about the object in a reconstruction of all placements; nil if it does not
  /// contain enough of them.
  func prior(
    in joined: Reconstruction, _ images: ImageStore
  ) throws -> MaskPrior.Placement? {
    var part = joined
    for index in part.poses.indices where !photos.contains(index) { part.poses[index] = nil }
    let pairs = photos.compactMap { photo in
      poses[photo].flatMap { own in joined.poses[photo].map { (own.center, $0.center) } }
    }
    guard let silhouettes = try Silhouettes(part, images: images),
      let toJoined = SimilarityTransform.fitting(pairs.map(\.0), to: pairs.map(\.1))
    else { return nil }
    // The masks of all placements together get the same files.
    try silhouettes.readMasks(KernelControl())
    return MaskPrior.Placement(
      photos: Set(photos), silhouettes: silhouettes, points: masks.points.transformed(by: toJoined))
  }
}
