import Foundation
import ImageFiles
import SceneModel

/// What is kept of a photo after decoding it once: enough to compare it with the others.
package struct InspectedPhoto: Codable, Sendable {
  /// Index among all files of the folder.
  package var sampleID: Int
  package var url: URL
  /// Size in pixels, upright.
  package var width: Int
  package var height: Int
  package var metadata: PhotoMetadata
  /// XXH64 of the file's bytes.
  package var contentHash: UInt64
  package var sharpness: SharpnessLadder
  /// The whole photo, upright and gray, with at most `PhotoInspection.thumbnailSide` pixels per
  /// side.
  package var thumbnail = RasterImage(width: 0, height: 0, channels: 1)
  /// The mask of the photo, if it has one.
  var mask: MaskInspection.ValidatedMask?
  /// The photo's mask if it is unusable.
  var rejectedMask: RejectedMask?
  /// Gravity and depth that the file itself contains.
  var reading = SensorReading()
  /// Whether the file contains depth without a scale, which can't be used.
  var hasRelativeDepth = false

  /// All but the thumbnail, which is stored as pixels.
  private enum CodingKeys: CodingKey {
    case sampleID, url, width, height, metadata, contentHash, sharpness, mask, rejectedMask
    case reading, hasRelativeDepth
  }
}

extension InspectedPhoto {
  /// Accelerations, in units of the gravity of Earth, of a phone that is held still; with others,
  /// the direction isn't that of gravity. Chosen.
  private static let accelerationAtRest = 0.8...1.2

  /// Finds gravity and depth in the file's content.
  mutating func findReading(_ bytes: [UInt8]) {
    if let vector = metadata.acceleration, Self.accelerationAtRest.contains(vector.length) {
      reading.gravity = SensorReading.gravity(
        ofPhone: vector, orientation: metadata.sensorOrientation)
    }
    switch EmbeddedDepth(bytes) {
    case .metric(let map): reading.depth = map
    case .relative: hasRelativeDepth = true
    case nil: break
    }
  }

  /// Reads the mask from a file, or from the alpha channel of the photo, whose file content is
  /// `bytes`.
  mutating func findMask(_ file: URL?, _ bytes: [UInt8]) {
    let isTurned = metadata.orientation >= 5
    let stored = MaskInspection.StoredPhoto(
      name: url.lastPathComponent, width: isTurned ? height : width,
      height: isTurned ? width : height, orientation: metadata.orientation)
    do throws(MaskFault) {
      if let file {
        mask = try MaskInspection().file(file, of: stored)
      } else {
        mask = try MaskInspection().alpha(bytes, of: stored)
      }
    } catch {
      rejectedMask = error.mask
    }
  }
}
