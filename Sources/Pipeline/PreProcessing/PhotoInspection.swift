import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Reads and decodes one file and makes all checks that don't depend on the other photos.
package struct PhotoInspection: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    package var limits = ImageCodec.Limits()
    /// Minimum number of pixels; smaller photos show too little to align. Chosen.
    package var minimumPixels = 100_000
    /// Minimum number of pixels of the shorter side. Chosen.
    package var minimumSide = 240
    /// Pixels of the copy that sharpness is measured on, which makes photos of all sizes
    /// comparable. Chosen.
    package var sharpnessPixels = 1_000_000
    /// Whether masks are read.
    package var usesMasks = true

    package init() {}
  }

  /// Longer side of the thumbnail in pixels. Chosen: sixteen blocks of `DuplicateDetection`.
  static let thumbnailSide = 256

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Inspects one file. `mask` is the mask file of the photo; without it, the alpha channel is
  /// used. Throws `Rejection` if the photo is unusable.
  package func run(_ url: URL, sampleID: Int, mask: URL? = nil) throws -> InspectedPhoto {
    let name = url.lastPathComponent
    func rejection(_ fault: RejectedPhoto.Fault, _ sentenceEnd: String) -> Rejection {
      Rejection(RejectedPhoto(sampleID: sampleID, name: name, fault: fault, end: sentenceEnd))
    }
    do {
      let bytes = try ImageCodec.contents(of: url, limits: options.limits)
      let header = try ImageHeader(bytes)
      guard min(header.width, header.height) >= options.minimumSide,
        header.width.multipliedReportingOverflow(by: header.height).partialValue
          >= options.minimumPixels
      else {
        throw rejection(
          .tooSmall,
          "it has \(header.width) × \(header.height) pixels; photos need \(options.minimumSide) "
            + "or more per side and \(options.minimumPixels) or more in total")
      }
      let metadata = PhotoMetadata(bytes)
      let upright = try ImageCodec.decode(bytes, limits: options.limits)
        .turned(byOrientation: metadata.orientation)
      let reduced = try upright.reduced(to: options.sharpnessPixels).gray
      let sharpness: SharpnessLadder
      do {
        sharpness = try SharpnessLadder(reduced)
      } catch KernelError.degenerate {
        throw rejection(.blank, "it is blank: it is badly exposed, or the lens was covered")
      }
      var photo = InspectedPhoto(
        sampleID: sampleID, url: url, width: upright.width, height: upright.height,
        metadata: metadata, contentHash: XXHash64.hash(bytes), sharpness: sharpness,
        thumbnail: try reduced.fitted(to: Self.thumbnailSide))
      photo.findReading(bytes)
      if options.usesMasks { photo.findMask(mask, bytes) }
      return photo
    } catch let error as ImageError {
      throw rejection(error.fault, error.errorDescription ?? "it can't be read")
    }
  }
}

extension RejectedPhoto {
  /// `end` completes the sentence "NAME is not used: …".
  init(sampleID: Int, name: String, fault: Fault, end: String) {
    self.init(
      sampleID: sampleID, name: name, fault: fault, reason: "\(name) is not used: \(end).")
  }
}

extension ImageError {
  var fault: RejectedPhoto.Fault {
    switch self {
    case .unsupportedFormat, .decoderLeftOut, .notAnImage: .unsupportedFormat
    case .tooLarge: .tooLarge
    case .damaged, .unreadable: .unreadable
    }
  }
}

extension RasterImage {
  /// The image reduced by area averaging to at most `maximumPixels`.
  func reduced(to maximumPixels: Int) throws -> RasterImage {
    let size = ImageStore.size(width: width, height: height, maximumPixels: maximumPixels)
    return try resized(width: size.width, height: size.height)
  }

  /// The image reduced so that the longer side has at most `side` pixels.
  func fitted(to side: Int) throws -> RasterImage {
    let scale = min(1, Double(side) / Double(max(width, height)))
    return try resized(
      width: max(1, Int((Double(width) * scale).rounded())),
      height: max(1, Int((Double(height) * scale).rounded())))
  }
}
