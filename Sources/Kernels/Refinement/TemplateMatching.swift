import CKernels
import SceneModel

/// Locates small square templates in other photos, to a few hundredths of a pixel.
///
/// Least squares matching (Gruen, "Adaptive least squares correlation", 1985) of position, gain and
/// offset in the inverse compositional form (Baker and Matthews, IJCV 2004). The shape of the
/// square in the other photo is given, not estimated: where the geometry is known, each parameter
/// less improves the accuracy of the position.
package struct TemplateMatching: Hashable, Codable, Sendable {
  /// A square around a pixel.
  package struct Location: Hashable, Sendable {
    /// The center in pixels, origin at the top-left corner.
    package var center: SIMD2<Double>
    /// Pixel spacing of the 11 × 11 samples.
    package var step: Double

    package init(center: SIMD2<Double>, step: Double) {
      self.center = center
      self.step = step
    }
  }

  /// Sampled textures of squares, in the order of their locations.
  package struct Templates: Sendable {
    package fileprivate(set) var samples: [UInt16]
    /// Whether each lies within its photo and has texture in two directions.
    package fileprivate(set) var isValid: [Bool]

    /// `count` invalid templates.
    package init(count: Int) {
      samples = Array(repeating: 0, count: count * Int(CK_TEMPLATE_SAMPLES))
      isValid = Array(repeating: false, count: count)
    }

    /// Copies all of `other`: its template i becomes number `indices[i]`.
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

  /// A template and where it is expected.
  package struct Search: Hashable, Sendable {
    /// Index of the template.
    package var template: Int
    /// Sample spacing in pixels of the template's photo.
    package var step: Double
    /// The Jacobian, in row order, of the pixel in the searched photo with respect to the pixel in
    /// the template's photo.
    package var warp: SIMD4<Double>
    /// The expected center in pixels of the searched photo.
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

  /// A located template.
  package struct Match: Hashable, Sendable {
    /// Pixels of the searched photo, origin at the top-left corner.
    package var center: SIMD2<Double>
    /// Zero-mean normalized cross-correlation, at most 1.
    package var zncc: Double
    /// The covariance of the center in square pixels: xx, xy, yy.
    package var covariance: SIMD3<Double>
  }

  /// Maximum distance in pixels from the expected center. Chosen.
  package var maximumShift = 3.0
  /// All instruction sets give the same result.
  package var instructions = Instructions.automatic

  package init() {}

  /// Samples the templates of one photo.
  package static func templates(
    of locations: [Location], in image: RasterImage, instructions: Instructions = .automatic
  ) throws -> Templates {
    var templates = Templates(count: locations.count)
    var valid = [UInt8](repeating: 0, count: locations.count)
    let raw = locations.map { ck_template_location(x: $0.center.x, y: $0.center.y, step: $0.step) }
    try withKernel(KernelControl()) { _ in
      image.withKernelPixels {
        ck_extract_templates(
          $0, raw, raw.count, instructions.raw, &templates.samples, &valid)
      }
    }
    templates.isValid = valid.map { $0 != 0 }
    return templates
  }

  /// The match of each search in one photo; nil if it left the photo or its surroundings, or didn't
  /// converge.
  package func matches(
    _ searches: [Search], of templates: Templates, in image: RasterImage
  ) throws -> [Match?] {
    var matches = [ck_template_match](repeating: ck_template_match(), count: searches.count)
    let raw = searches.map { search in
      ck_template_search(
        index: Int32(search.template), step: search.step,
        warp: (search.warp.x, search.warp.y, search.warp.z, search.warp.w),
        x: search.expected.x, y: search.expected.y)
    }
    try withKernel(KernelControl()) { _ in
      image.withKernelPixels {
        ck_match_templates(
          $0, templates.samples, templates.isValid.count, raw, raw.count, maximumShift,
          instructions.raw, &matches)
      }
    }
    return matches.map {
      $0.zncc > -1
        ? Match(center: [$0.x, $0.y], zncc: $0.zncc, covariance: [$0.xx, $0.xy, $0.yy]) : nil
    }
  }
}
