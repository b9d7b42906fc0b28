/// A mask that is not used, and the reason; its photo is used without a mask.
package struct RejectedMask: Hashable, Codable, Sendable {
  /// The name of the mask file, or of the photo with the alpha channel.
  package var name: String
  /// A message for the user.
  package var reason: String

  package init(name: String, reason: String) {
    self.name = name
    self.reason = reason
  }
}
