import CKernels
import SceneModel

/// Finds small squares of texture again in other photos, to a few hundredths of a pixel.
///
/// Least squares matching (Gruen, "Adaptive least squares correlation", 1985) of position, gain and
/// offset in the inverse compositional form (Baker and Matthews, IJCV 2004). The shape of the square in
/// the other photo is given, not estimated: where the geometry is known, every free parameter less
/// makes the position better.
package struct TemplateMatching: Hashable, Codable, Sendable {
  /// A square around a pixel.
  package struct Place: Hashable, Sendable {
    /// The centre in pixels, origin at the top-left corner.
    package var center: SIMD2<Double>
    /// Pixels from one of the 11 × 11 samples to the next.
    package var step: Double

    package init(center: SIMD2<Double>, step: Double) {
      self.center = center
      self.step = step
    }
  }

  /// Textures of squares, in the order of their places.
  package struct Templates: Sendable {
    fileprivate var samples: [UInt16]
    /// Whether each lies within its photo and holds texture in two directions.
    package fileprivate(set) var isValid: [Bool]

    /// No template of any place.
    package init(count: Int) {
      samples = Array(repeating: 0, count: count * Int(CK_TEMPLATE_SAMPLES))
      isValid = Array(repeating: false, count: count)
    }

    /// Takes over all of `other`: its template i becomes number `indices[i]`.
    package mutating func insert(_ other: Templates, at indices: [Int]) {
      let size = Int(CK_TEMPLATE_SAMPLES)
      for (source, target) in indices.enumerated() {
        isValid[target] = other.isValid[source]
        samples.replaceSubrange(
          target * size..<(target + 1) * size,
          with: other.samples[source * size..<(source + 1) * size])
      }
    }
  }

  /// Where a template is expected.
  package struct Search: Hashable, Sendable {
    /// Index of the template.
    package var template: Int
    /// Pixels of the template's photo from one sample to the next.
    package var step: Double
    /// The derivative, by rows, of the pixel in the searched photo by the pixel in the template's.
    package var warp: SIMD4<Double>
    /// The expected centre in pixels of the searched photo.
    package var expected: SIMD2<Double>

    package init(
      template: Int, step: Double, warp: SIMD4<Double>, expected: SIMD2<Double>
    ) {
      self.template = template
      self.step = step
      self.warp = warp
      self.expected = expected
    }
  }

  /// Where a template was found.
  package struct Find: Hashable, Sendable {
    package var center: SIMD2<Double>
    /// Zero-mean normalised cross-correlation, at most 1.
    package var zncc: Double
  }

  /// Pixels from the expected centre at which a search gives up.
  package var maximumShift = 3.0

  package init() {}

  /// The textures of squares of one photo.
  package static func templates(of places: [Place], in image: RasterImage) throws -> Templates {
    var templates = Templates(count: places.count)
    var valid = [UInt8](repeating: 0, count: places.count)
    let raw = places.map { ck_template_place(x: $0.center.x, y: $0.center.y, step: $0.step) }
    try withKernel(KernelControl()) { _ in
      ck_extract_templates(
        image.pixels, Int32(image.width), Int32(image.height), Int32(image.channels),
        image.width * image.channels, raw, raw.count, &templates.samples, &valid)
    }
    templates.isValid = valid.map { $0 != 0 }
    return templates
  }

  /// Each search's find in one photo; nil where it left the photo, its surroundings or didn't settle.
  package func finds(
    _ searches: [Search], of templates: Templates, in image: RasterImage
  ) throws -> [Find?] {
    var finds = [ck_template_find](repeating: ck_template_find(), count: searches.count)
    let raw = searches.map { search in
      ck_template_search(
        index: Int32(search.template), step: search.step,
        warp: (search.warp.x, search.warp.y, search.warp.z, search.warp.w),
        x: search.expected.x, y: search.expected.y)
    }
    try withKernel(KernelControl()) { _ in
      ck_match_templates(
        image.pixels, Int32(image.width), Int32(image.height), Int32(image.channels),
        image.width * image.channels, templates.samples, templates.isValid.count, raw, raw.count,
        maximumShift, &finds)
    }
    return finds.map { $0.zncc > -1 ? Find(center: [$0.x, $0.y], zncc: $0.zncc) : nil }
  }
}
