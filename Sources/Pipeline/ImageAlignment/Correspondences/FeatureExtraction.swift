import Kernels
import SceneModel

/// Detects the features of every photo with SIFT (Lowe, IJCV 2004).
///
/// If a photo has a mask, features outside the object are discarded, because the masked-out area
/// may move relative to the object. On a turntable, for example, the background would indicate that
/// the camera never moved.
package struct FeatureExtraction: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Sensitivity of the detector.
    package var sensitivity = FeatureSensitivity.normal
    package var detection = FeatureDetection()
    /// Photos with at most this number of pixels are upsampled by two for the first octave, which
    /// finds the smallest features. Larger photos have enough features without it: color filter
    /// mosaics and lenses resolve less than the pixel grid. Measured: tuned on the sets marked so
    /// in Benchmarks/sets.json.
    package var doubledPixels = 3_200_000
    /// Largest number of pixels that is searched; larger photos are reduced to it. Measured: as
    /// above.
    package var maximumPixels = 6_500_000
    /// A photo with fewer features than this is searched again with the contrast threshold
    /// multiplied by `sparseFactor`. Chosen.
    package var sparseFeatures = 1500
    package var sparseFactor = 0.4
    /// Minimum number of pixels per feature, so that tiny photos don't get more features than they
    /// can hold. Chosen.
    package var pixelsPerFeature = 80
    /// Photos with fewer pixels get fewer features, in proportion to their side length: the cost of
    /// matching grows with the square of the number of features. Chosen: with preemptive matching,
    /// AUC at 0.1° of boot fell from 0.846 to 0.821 (docs/experiments/2026-11-alignment.md).
    package var manyFeaturePixels = 2_000_000
    /// Distance beyond the mask up to which features are kept, as a fraction of the photo's longer
    /// side. Chosen.
    package var maskMargin = 0.002
    /// Changes made by high sensitivity.
    package var high = HighSensitivity()

    package init() {}

    /// The largest number of pixels that is searched, for the sensitivity.
    var photoPixels: Int { sensitivity == .high ? high.maximumPixels : maximumPixels }

    /// The detector's options for a photo.
    fileprivate func detection(for photo: Photo) -> FeatureDetection {
      var detection = detection
      guard sensitivity == .high else {
        detection.doublesPhoto = photo.width * photo.height <= doubledPixels
        return detection
      }
      detection.contrastThreshold *= high.contrastFactor
      detection.edgeThreshold *= high.edgeFactor
      detection.maximumFeatures *= high.featureFactor
      detection.sufficientFeatures *= high.featureFactor
      return detection
    }
  }

  /// The changes that high sensitivity makes: every photo is upsampled, and more, fainter and more
  /// edge-like features are kept.
  package struct HighSensitivity: Hashable, Codable, Sendable {
    /// Multiplies the contrast threshold. Chosen: with all changes, 1473 points of a faint statue
    /// become 2541 (docs/experiments/2026-11-alignment.md, Low texture).
    package var contrastFactor = 0.25
    /// Multiplies the limit on the ratio of principal curvatures. Chosen.
    package var edgeFactor = 1.6
    /// Multiplies the maximum numbers of features and divides the minimum number of pixels per
    /// feature. Chosen.
    package var featureFactor = 2
    /// Larger photos are reduced to this number of pixels. Chosen: upsampled, they are 16 MP.
    package var maximumPixels = 4_000_000

    package init() {}
  }

  /// A photo with fewer features can rarely be registered. Chosen.
  static let fewFeatures = 100

  package var options: Options
  /// Features that other processes have extracted or will need.
  var units: UnitStore?

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns one feature set per photo, in pixels of the upright photo at full size; empty where
  /// there is no texture.
  package func run(
    _ photos: [Photo], images: ImageStore, _ context: StageContext
  ) throws -> [FeatureSet] {
    let sets = try context.control.parallelMap(photos.count) { [self] index in
      guard let units else { return try Self.features(of: photos[index], images, options) }
      return try units.value(.features, madeFrom: try key(of: photos[index], images)) {
        try Self.features(of: photos[index], images, options)
      }
    }
    context.notes.record("features", Double(sets.reduce(0) { $0 + $1.count }))
    for (photo, set) in zip(photos, sets) where set.count < Self.fewFeatures {
      let part = photo.mask == nil ? "" : " inside its mask"
      context.notes.warn(
        "\(photo.name) shows hardly any texture\(part) (\(set.count) features); it may not be used."
      )
    }
    return sets
  }

  /// A number that changes with everything that the features of a photo depend on.
  func key(of photo: Photo, _ images: ImageStore) throws -> UInt64 {
    var key = Fingerprint()
    key.add(try images.fingerprint(of: photo.id))
    key.add(images.hasMasks ? 1 : 0)
    key.add(try Fingerprint.content(of: options))
    return key.value
  }

  private static func features(
    of photo: Photo, _ images: ImageStore, _ options: Options
  ) throws -> FeatureSet {
    var detection = options.detection(for: photo)
    let image = try images.image(photo.id, maximumPixels: options.photoPixels)
    let margin = max(1, options.maskMargin * Double(max(image.width, image.height)))
    let mask = try images.mask(photo.id, maximumPixels: options.photoPixels)?
      .dilated(by: Int(margin.rounded()))
    // Each task is single-threaded; tasks run in parallel.
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
  /// Scales positions and sizes from the reduced photo to the full-size photo.
  fileprivate mutating func scale(by factor: SIMD2<Float>) {
    guard factor != [1, 1] else { return }
    let mean = (factor.x * factor.y).squareRoot()
    for index in positions.indices {
      positions[index] *= factor
      scales[index] *= mean
    }
  }
}
