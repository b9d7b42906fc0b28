import Foundation

/// Where it is told which pixels of a photo show the object.
package struct PhotoMask: Hashable, Codable, Sendable {
  /// An image of its own; nil where the photo's alpha channel tells.
  package var file: URL?
  /// EXIF orientation 1…8 that turns the stored mask as the upright photo is.
  package var orientation: Int
  /// XXH64 of the mask file's bytes; 0 for an alpha channel.
  package var contentHash: UInt64
  /// Share of the photo's pixels that show the object, above 0 and up to 1.
  package var coverage: Double

  package init(file: URL?, orientation: Int, contentHash: UInt64 = 0, coverage: Double) {
    self.file = file
    self.orientation = orientation
    self.contentHash = contentHash
    self.coverage = coverage
  }
}

/// A mask that is not used, and why; its photo is used whole.
package struct RefusedMask: Hashable, Codable, Sendable {
  /// The name of the mask's file, or of the photo that has it as alpha channel.
  package var name: String
  /// A sentence for the user.
  package var reason: String

  package init(name: String, reason: String) {
    self.name = name
    self.reason = reason
  }
}
