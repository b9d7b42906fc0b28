import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Makes the small pictures of all photos of a run.
struct ReportPictures {
  /// The side on which the outlines of masks are traced, in pixels. Chosen.
  private static let maskSide = 240

  let ingested: IngestedPhotos
  let images: ImageStore
  /// Nil if alignment failed.
  let reconstruction: Reconstruction?

  /// The pictures of the photos with these names; nil for files that can't be read.
  func run(names: [String], _ control: KernelControl) throws -> [PhotoPicture?] {
    let side = PhotoPicture.side(count: names.count)
    let photos = Dictionary(
      ingested.photos.map { ($0.name, $0) }, uniquingKeysWith: { first, _ in first })
    let rejected = Dictionary(
      ingested.rejected.map { ($0.name, $0.sampleID) }, uniquingKeysWith: { first, _ in first })
    let residuals = reconstruction?.residuals ?? []
    return try control.parallelMap(names.count) { index in
      if let photo = photos[names[index]] {
        return try? picture(of: photo, side, residuals)
      }
      return rejected[names[index]].flatMap { picture(ofRejected: $0, side) }
    }
  }

  private func picture(
    of photo: Photo, _ side: Int, _ residuals: [[Reconstruction.Residual]]
  ) throws -> PhotoPicture {
    let longer = Double(max(photo.width, photo.height))
    func pixels(_ side: Int) -> Int {
      let scale = min(1, Double(side) / longer)
      return Int((Double(photo.width) * scale * Double(photo.height) * scale).rounded(.up))
    }
    var result = try PhotoPicture(try images.image(photo.id, maximumPixels: pixels(side)))
    if let mask = try images.mask(photo.id, maximumPixels: pixels(Self.maskSide)) {
      result.add(MaskOutlines(mask), of: mask)
    }
    if residuals.indices.contains(photo.id.index) {
      result.add(
        residuals[photo.id.index], size: SIMD2(Double(photo.width), Double(photo.height)))
    }
    return result
  }

  /// Of a file that is not used; nil if it can't be decoded.
  private func picture(ofRejected sampleID: Int, _ side: Int) -> PhotoPicture? {
    guard ingested.files.indices.contains(sampleID),
      let bytes = try? ImageCodec.contents(of: ingested.files[sampleID]),
      let image = try? ImageCodec.decode(bytes)
        .turned(byOrientation: PhotoMetadata(bytes).orientation).fitted(to: side)
    else { return nil }
    return try? PhotoPicture(image)
  }
}
