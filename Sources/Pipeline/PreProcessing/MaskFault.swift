import SceneModel

/// The reason why a mask is not used.
struct MaskFault: Error {
  var mask: RejectedMask

  /// `reason` completes the sentence "NAME is not used as a mask: …".
  init(_ name: String, _ photo: String, _ reason: String) {
    mask = RejectedMask(
      name: name,
      reason: "\(name) is not used as a mask: \(reason). \(photo) is used without a mask.")
  }
}
