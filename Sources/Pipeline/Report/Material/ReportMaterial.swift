import Foundation
import ImageFiles
import Kernels
import SceneModel

/// What the page of a report shows besides the figures of `RunReport`: pictures, the model and
/// points. Encoded as JSON, with bytes in base 64.
package struct ReportMaterial: Encodable, Sendable {
  /// Parallel to `RunReport.photos`; nil for a file that is no readable photo.
  package var photos: [PhotoPicture?] = []
  /// Nil if the run made none.
  package var model: PageModel?
  package var points = Points()
  /// The model from eight sides, as a data URL.
  package var pictures: String?

  /// The JavaScript library in the page, which its license demands to be named.
  package var library: Library?
  /// Whether the page shows the model alone, with `facts`: pairs of a term and a value.
  package var isViewer = false
  package var facts: [[String]] = []

  private enum CodingKeys: String, CodingKey {
    case photos, model, points, pictures, library, facts
    case isViewer = "viewer"
  }

  package struct Library: Encodable, Sendable {
    package var name: String
    package var license: String

    package init(name: String, license: String) { (self.name, self.license) = (name, license) }
  }

  package struct Points: Encodable, Sendable {
    package var sparse: PagePoints?
    package var dense: PagePoints?
  }

  package init() {}

  /// The pictures of photos that were read, in the order of `names`.
  package init(
    _ ingested: IngestedPhotos, images: ImageStore, names: [String], _ control: KernelControl
  ) throws {
    photos = try ReportPictures(ingested: ingested, images: images, reconstruction: nil)
      .run(names: names, control)
  }
}

extension Data {
  /// The bytes of numbers, little-endian.
  init<Number: FixedWidthInteger & BitwiseCopyable>(littleEndian numbers: [Number]) {
    self = numbers.map(\.littleEndian).withUnsafeBytes { Data($0) }
  }
}

extension RasterImage {
  /// A JPEG file as a data URL; `quality` is 0…1. WebP takes two thirds of the bytes, but ten times
  /// as long.
  func dataURL(quality: Float) throws -> String {
    let bytes = try ImageCodec.encodeJPEG(self, quality: quality)
    return "data:image/jpeg;base64,\(Data(bytes).base64EncodedString())"
  }
}
