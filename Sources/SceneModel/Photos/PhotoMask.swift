import Foundation

/// The source of the mask that marks the object in a photo.
package struct PhotoMask: Hashable, Codable, Sendable {
  /// The mask image; nil if the mask is the photo's alpha channel.
  package var file: URL?
  /// EXIF orientation 1…8 that rotates the stored mask to match the upright photo.
  package var orientation: Int
  /// XXH64 of the mask file's bytes; 0 for an alpha channel.
  package var contentHash: UInt64
  /// Fraction of the photo's pixels on the object, above 0 and at most 1.
  package var coverage: Double

  package init(file: URL?, orientation: Int, contentHash: UInt64 = 0, coverage: Double) {
    self.file = file
    self.orientation = orientation
    self.contentHash = contentHash
    self.coverage = coverage
  }
}
