import Kernels
import SceneModel

/// The photos at the size in which templates are read and looked for.
struct TemplateReading: Sendable {
  let photos: [Photo]
  let images: ImageStore
  /// Photos of more pixels are reduced to this size.
  let workingPixels: Int

  /// A photo at working size, and working pixels a pixel of the full photo, by axis.
  func image(_ photo: Int) throws -> (image: RasterImage, factor: SIMD2<Double>) {
    let image = try images.image(ID(photo), maximumPixels: workingPixels)
    let full = SIMD2(Double(photos[photo].width), Double(photos[photo].height))
    return (image, SIMD2(Double(image.width), Double(image.height)) / full)
  }

  /// Tells whether a place, in working pixels, shows the object, for all that the photo's mask tells.
  func isOfObject(_ photo: Int) throws -> (SIMD2<Double>) -> Bool {
    guard let mask = try images.mask(ID(photo), maximumPixels: workingPixels) else {
      return { _ in true }
    }
    return { place in mask.isMarked(at: place) }
  }

  /// The template of each reference, by its index; none where there is no reference.
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
        TemplateMatching.Place(center: $0.pixel * factor, step: $0.step * factor.x)
      }
      return try TemplateMatching.templates(of: places, in: image)
    }
    var templates = TemplateMatching.Templates(count: references.count)
    for (photo, part) in read.enumerated() { templates.insert(part, at: ofPhoto[photo]) }
    return templates
  }
}
