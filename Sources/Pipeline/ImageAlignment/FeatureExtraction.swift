import Kernels
import SceneModel

/// Finds the features of every photo by SIFT (Lowe, IJCV 2004).
package struct FeatureExtraction {
  package struct Options: Hashable, Codable, Sendable {
    /// How hard to look.
    package enum Sensitivity: String, Hashable, Codable, Sendable { case normal, high }

    package var sensitivity = Sensitivity.normal
    package var detection = FeatureDetection()
    /// High sensitivity multiplies the contrast threshold by this.
    package var highSensitivityFactor = 0.4
    /// A photo with fewer features than this is searched again at high sensitivity.
    package var sparseFeatures = 1500
    /// Photos of more pixels than this are reduced before the search. Sensors with a mosaic of colours
    /// and lenses resolve less than their pixels, and the first octave doubles the photo anyway.
    package var unreducedPixels = 2_400_000
    /// Pixels of a reduced photo.
    package var reducedPixels = 1_600_000
    /// Pixels of the largest photo that is searched at full size at high sensitivity; larger ones are
    /// reduced to it.
    package var highSensitivityPixels = 6_500_000
    /// Pixels for each feature at least, so that tiny photos don't get more than they hold.
    package var pixelsPerFeature = 80

    package init() {}

    fileprivate func maximumPixels(of photo: Photo) -> Int {
      if sensitivity == .high { return highSensitivityPixels }
      return photo.width * photo.height <= unreducedPixels ? unreducedPixels : reducedPixels
    }
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
      context.notes.warn(
        "\(photo.name) shows hardly any texture (\(set.count) features); it may not be used.")
    }
    return sets
  }

  private static func features(
    of photo: Photo, _ images: ImageStore, _ options: Options
  ) throws -> FeatureSet {
    let image = try images.image(photo.id, maximumPixels: options.maximumPixels(of: photo))
    // A unit runs on one thread; the units run side by side.
    let control = KernelControl()
    var detection = options.detection
    detection.maximumFeatures = min(
      detection.maximumFeatures, image.width * image.height / max(1, options.pixelsPerFeature))
    if options.sensitivity == .high { detection.contrastThreshold *= options.highSensitivityFactor }
    var set = try detection.features(in: image, control)
    if set.count < options.sparseFeatures, options.sensitivity == .normal {
      detection.contrastThreshold *= options.highSensitivityFactor
      detection.sufficientFeatures = options.sparseFeatures
      set = try detection.features(in: image, control)
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
