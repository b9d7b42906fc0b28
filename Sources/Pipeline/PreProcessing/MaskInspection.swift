import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Reads the mask of one photo and validates it.
///
/// A mask usually has no EXIF data: programs write it in the orientation in which they display the
/// photo, or in that of the stored photo. The aspect ratio reveals which, unless it is the same for
/// both; then the other masks of the set decide, see `PhotoIngestion`.
struct MaskInspection: Sendable {
  /// A valid mask, and what remains ambiguous about its orientation.
  struct ValidatedMask: Codable, Sendable {
    var mask: PhotoMask
    /// An alternative orientation that is equally possible.
    var otherOrientation: Int?
    /// True if only the aspect ratio of the stored photo fits the mask, false if only that of the
    /// upright photo fits; nil if this is undetermined.
    var isAsStored: Bool?
  }

  /// A photo in stored orientation.
  struct StoredPhoto: Sendable {
    var name: String
    var width: Int
    var height: Int
    /// EXIF orientation that rotates it upright.
    var orientation: Int
  }

  /// Maximum relative deviation of a side from the photo's aspect ratio, in addition to one pixel
  /// of rounding. Chosen.
  static let aspectTolerance = 0.005

  /// Reads a mask from its file; throws if it is unusable.
  func file(_ url: URL, of photo: StoredPhoto) throws(MaskFault) -> ValidatedMask {
    let image: RasterImage
    let bytes: [UInt8]
    do throws(ImageError) {
      bytes = try ImageCodec.contents(of: url)
      image = try MaskImage.decode(bytes)
    } catch {
      throw MaskFault(
        url.lastPathComponent, photo.name, error.errorDescription ?? "it can't be read")
    }
    let exifOrientation = PhotoMetadata(bytes).orientation
    let coverage = try coverage(image, url.lastPathComponent, photo)
    var mask = PhotoMask(
      file: url, orientation: exifOrientation, contentHash: XXHash64.hash(bytes),
      coverage: coverage)
    if exifOrientation != 1 {
      guard fits(image, turned: exifOrientation, photo) else {
        throw aspectFault(image, url, photo)
      }
      return ValidatedMask(mask: mask)
    }
    let (isUpright, isStored) = (
      fits(image, turned: 1, photo), fits(image, turned: photo.orientation, photo)
    )
    guard isUpright || isStored else { throw aspectFault(image, url, photo) }
    if !isUpright { mask.orientation = photo.orientation }
    guard photo.orientation != 1 else { return ValidatedMask(mask: mask) }
    return isUpright && isStored
      ? ValidatedMask(mask: mask, otherOrientation: photo.orientation)
      : ValidatedMask(mask: mask, isAsStored: isStored)
  }

  /// Reads the mask from the alpha channel of a photo; nil without one, or if nothing is
  /// transparent. Throws if it is unusable.
  func alpha(_ bytes: [UInt8], of photo: StoredPhoto) throws(MaskFault) -> ValidatedMask? {
    let image: RasterImage?
    do throws(ImageError) {
      image = try MaskImage.alpha(bytes)
    } catch {
      throw MaskFault(
        "The alpha channel of \(photo.name)", photo.name,
        error.errorDescription ?? "it can't be read")
    }
    guard let image else { return nil }
    let coverage = try coverage(image, "The alpha channel of \(photo.name)", photo)
    return coverage == 1
      ? nil
      : ValidatedMask(
        mask: PhotoMask(file: nil, orientation: photo.orientation, coverage: coverage))
  }

  /// The fraction of marked pixels, above 0; throws if nothing is marked.
  private func coverage(
    _ image: RasterImage, _ name: String, _ photo: StoredPhoto
  ) throws(MaskFault) -> Double {
    let marked = image.pixels.reduce(0) { $0 + ($1 == 0 ? 0 : 1) }
    guard marked > 0 else { throw MaskFault(name, photo.name, "no pixel is marked") }
    return Double(marked) / Double(image.pixels.count)
  }

  /// Whether the mask, rotated by `orientation`, has the aspect ratio of the upright photo.
  private func fits(_ mask: RasterImage, turned orientation: Int, _ photo: StoredPhoto) -> Bool {
    let (width, height) = Self.size(mask.width, mask.height, turned: orientation)
    let (w, h) = Self.size(photo.width, photo.height, turned: photo.orientation)
    let expected = Double(width) * Double(h) / Double(w)
    return abs(expected - Double(height)) <= 1 + Self.aspectTolerance * Double(height)
  }

  private static func size(
    _ width: Int, _ height: Int, turned orientation: Int
  ) -> (width: Int, height: Int) {
    orientation >= 5 ? (height, width) : (width, height)
  }

  private func aspectFault(_ mask: RasterImage, _ url: URL, _ photo: StoredPhoto) -> MaskFault {
    let (width, height) = Self.size(photo.width, photo.height, turned: photo.orientation)
    return MaskFault(
      url.lastPathComponent, photo.name,
      "it has \(mask.width) × \(mask.height) pixels, but the photo has another aspect ratio "
        + "(\(width) × \(height))")
  }
}
