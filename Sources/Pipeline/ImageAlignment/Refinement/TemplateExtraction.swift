import Kernels
import SceneModel

/// Reads templates from the photos at working size.
struct TemplateExtraction: Sendable {
  let photos: [Photo]
  let images: ImageStore
  /// Photos with more pixels are reduced to this size.
  let workingPixels: Int

  /// A photo at working size, and working pixels per pixel of the full-size photo, by axis.
  func image(_ photo: Int) throws -> (image: RasterImage, factor: SIMD2<Double>) {
    let image = try images.image(ID(photo), maximumPixels: workingPixels)
    let full = SIMD2(Double(photos[photo].width), Double(photos[photo].height))
    return (image, SIMD2(Double(image.width), Double(image.height)) / full)
  }

  /// Returns a predicate for whether a position, in working pixels, is on the object according to
  /// the photo's mask; always true without a mask.
  func isOnObject(_ photo: Int) throws -> (SIMD2<Double>) -> Bool {
    guard let mask = try images.mask(ID(photo), maximumPixels: workingPixels) else {
      return { _ in true }
    }
    return { pixel in mask.isMarked(at: pixel) }
  }

  /// The template of each reference, by index; invalid where the reference is nil.
  func templates(
    of references: [TrackReference?], _ control: KernelControl
  ) throws -> TemplateMatching.Templates {
    var ofPhoto = [[Int]](repeating: [], count: photos.count)
    for (index, reference) in references.enumerated() {
      if let reference { ofPhoto[reference.photo].append(index) }
    }
    let read = try control.parallelMap(photos.count) { [ofPhoto] photo in
      guard !ofPhoto[photo].isEmpty else { return TemplateMatching.Templates(count: 0) }
      let (image, factor) = try image(photo)
      let places = ofPhoto[photo].compactMap { references[$0] }.map {
        TemplateMatching.Location(center: $0.pixel * factor, step: $0.step * factor.x)
      }
      return try TemplateMatching.templates(of: places, in: image)
    }
    var templates = TemplateMatching.Templates(count: references.count)
    for (photo, part) in read.enumerated() { templates.insert(part, at: ofPhoto[photo]) }
    return templates
  }
}
