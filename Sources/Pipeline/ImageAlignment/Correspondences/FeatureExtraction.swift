import Kernels
import SceneModel

/// Finds the features of every photo by SIFT (Lowe, IJCV 2004).
///
/// Of a photo with a mask, features beside the object are not used: what a mask leaves out needn't
/// stand still. On a turntable the background would else tell that the camera never moved.
package struct FeatureExtraction {
  package struct Options: Hashable, Codable, Sendable {
    /// How hard to look.
    package enum Sensitivity: String, Hashable, Codable, Sendable { case normal, high }

    package var sensitivity = Sensitivity.normal
    package var detection = FeatureDetection()
    /// Photos of at most this number of pixels are doubled for the first octave, which finds the small
    /// features. Larger ones have enough without: sensors with a mosaic of colours and lenses resolve
    /// less than their pixels.
    package var doubledPixels = 3_200_000
    /// Pixels of the largest photo that is searched at full size; larger ones are reduced to it.
    package var maximumPixels = 6_500_000
    /// A photo with fewer features than this is searched again with the threshold of contrast
    /// multiplied by `sparseFactor`.
    package var sparseFeatures = 1500
    package var sparseFactor = 0.4
    /// Pixels for each feature at least, so that tiny photos don't get more than they hold.
    package var pixelsPerFeature = 80
    /// Photos of fewer pixels get fewer features, in proportion to their sides: matching takes the
    /// square of their number.
    package var manyFeaturePixels = 2_000_000
    /// How far beyond its mask an object may reach, as a fraction of the photo's longer side.
    package var maskMargin = 0.002
    /// How high sensitivity looks.
    package var high = HighSensitivity()

    package init() {}

    /// The size and the options to search a photo with.
    fileprivate func plan(of photo: Photo) -> (maximumPixels: Int, detection: FeatureDetection) {
      var detection = detection
      guard sensitivity == .high else {
        detection.doublesPhoto = photo.width * photo.height <= doubledPixels
        return (maximumPixels, detection)
      }
      detection.contrastThreshold *= high.contrastFactor
      detection.edgeThreshold *= high.edgeFactor
      detection.maximumFeatures *= high.featureFactor
      detection.sufficientFeatures *= high.featureFactor
      return (high.maximumPixels, detection)
    }
  }

  /// What high sensitivity changes: every photo is doubled, and fainter and more edge-like features are
  /// kept, and more of them.
  package struct HighSensitivity: Hashable, Codable, Sendable {
    /// Multiplies the contrast threshold.
    package var contrastFactor = 0.25
    /// Multiplies the limit on the ratio of principal curvatures.
    package var edgeFactor = 1.6
    /// Multiplies the numbers of features, the pixels for each feature divide by it.
    package var featureFactor = 2
    /// Larger photos are reduced to this number of pixels.
    package var maximumPixels = 4_000_000

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// One set a photo, in pixels of the upright photo at full size; empty where there is no texture.
  package func run(
    _ photos: [Photo], images: ImageStore, _ context: StageContext
  ) throws -> [FeatureSet] {
    let sets = try context.control.parallelMap(photos.count) { [options] index in
      try Self.features(of: photos[index], images, options)
    }
    context.notes.count("features", Double(sets.reduce(0) { $0 + $1.count }))
    for (photo, set) in zip(photos, sets) where set.count < 100 {
      let part = photo.mask == nil ? "" : " inside its mask"
      context.notes.warn(
        "\(photo.name) shows hardly any texture\(part) (\(set.count) features); it may not be used."
      )
    }
    return sets
  }

  private static func features(
    of photo: Photo, _ images: ImageStore, _ options: Options
  ) throws -> FeatureSet {
    var (maximumPixels, detection) = options.plan(of: photo)
    let image = try images.image(photo.id, maximumPixels: maximumPixels)
    let margin = max(1, options.maskMargin * Double(max(image.width, image.height)))
    let mask = try images.mask(photo.id, maximumPixels: maximumPixels)?
      .dilated(by: Int(margin.rounded()))
    // A unit runs on one thread; the units run side by side.
    let control = KernelControl()
    let factor = options.sensitivity == .high ? options.high.featureFactor : 1
    let pixels = image.width * image.height
    let share = min(1, (Double(pixels) / Double(max(1, options.manyFeaturePixels))).squareRoot())
    detection.maximumFeatures = min(
      Int(share * Double(detection.maximumFeatures)),
      pixels * factor / max(1, options.pixelsPerFeature))
    var set = try detection.features(in: image, mask: mask, control)
    if set.count < options.sparseFeatures, options.sensitivity == .normal {
      detection.contrastThreshold *= options.sparseFactor
      detection.sufficientFeatures = options.sparseFeatures
      set = try detection.features(in: image, mask: mask, control)
    }
    set.scale(by: [
      Float(photo.width) / Float(max(1, image.width)),
      Float(photo.height) / Float(max(1, image.height)),
    ])
    return set
  }
}

extension FeatureSet {
  /// From the pixels of a reduced photo to those of the full one.
  fileprivate mutating func scale(by factor: SIMD2<Float>) {
    guard factor != [1, 1] else { return }
    let mean = (factor.x * factor.y).squareRoot()
    for index in positions.indices {
      positions[index] *= factor
      scales[index] *= mean
    }
  }
}
