import Foundation
import SceneModel

/// The contents of an input folder: the usable photos, their cameras, and every rejected file with
/// the reason.
package struct IngestedPhotos: Codable, Sendable {
  /// IDs are dense, in the order of the files.
  package var photos: [Photo]
  /// Initial cameras from the metadata.
  package var cameras: [Camera]
  /// Rejected files, in the order of the files.
  package var rejected: [RejectedPhoto]
  /// Readings of other sensors, by sample ID.
  package var readings: [Int: SensorReading] = [:]
  /// All files of the folder except masks and sensor readings; a sample ID is an index into them.
  package var files: [URL]
  /// Masks that are not used, in the order of the files; their photos are used.
  package var rejectedMasks: [RejectedMask]
  /// XXH64 of each photo's file, by photo ID.
  package var contentHashes: [UInt64]
  /// Maximum pixels of a photo that stages may process within the memory budget; pass it to
  /// `ImageStore`.
  package var processingPixels: Int
  /// Whether a photo has more than `processingPixels`.
  package var isDownsampled: Bool
}
