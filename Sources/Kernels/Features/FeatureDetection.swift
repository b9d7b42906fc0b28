import CKernels
import SceneModel

/// SIFT detector with RootSIFT descriptors (Lowe, IJCV 2004; Arandjelović and Zisserman, CVPR
/// 2012).
package struct FeatureDetection: Hashable, Codable, Sendable {
  /// Maximum number of features, the strongest of each grid cell.
  package var maximumFeatures = 8000
  /// Lowe's contrast threshold for intensities 0…1.
  package var contrastThreshold = 0.02
  /// Bounds of a factor on the contrast threshold; the highest factor that still yields
  /// `sufficientFeatures` is used.
  package var lowestFactor = 0.8
  package var highestFactor = 1.2
  /// Sufficient number of features of a photo.
  package var sufficientFeatures = 6000
  /// Lowe's limit on the ratio of principal curvatures.
  package var edgeThreshold = 10.0
  /// Whether the first octave is the photo upsampled to twice its size, which detects small
  /// features, or the photo itself.
  package var doublesPhoto = true
  /// Scale samples per octave.
  package var octaveLayers = 3
  /// Gaussian blur of the first layer in pixels.
  package var sigma = 1.6
  /// Grid cells along the longer side, over which the features are balanced.
  package var gridCells = 12
  /// All vector instruction sets give the same bytes; the portable path differs by rounding.
  package var instructions = Instructions.automatic

  package init() {}

  /// The features of an image with 1, 3 (RGB) or 4 channels, sorted by scale, largest first.
  ///
  /// Positions are in the image's pixels, with the origin at the corner of the top-left pixel. An
  /// image without texture has none. Pixels where `mask`, gray and of the image's size, is 0 are
  /// excluded.
  package func features(
    in image: RasterImage, mask: RasterImage? = nil, _ control: KernelControl
  ) throws -> FeatureSet {
    if let mask, (mask.width, mask.height, mask.channels) != (image.width, image.height, 1) {
      throw KernelError.invalidArgument("the mask is not gray or not of the image's size")
    }
    var set = FeatureSet(
      positions: Array(repeating: .zero, count: maximumFeatures),
      scales: Array(repeating: 0, count: maximumFeatures),
      orientations: Array(repeating: 0, count: maximumFeatures),
      descriptors: Array(repeating: 0, count: maximumFeatures * FeatureSet.descriptorLength),
      colors: Array(repeating: .zero, count: maximumFeatures))
    var options = kernelOptions
    var count = 0
    try withKernel(control) { control in
      set.positions.withUnsafeMutableBytes { positions in
        set.colors.withUnsafeMutableBytes { colors in
          ck_sift_detect(
            image.pixels, Int32(image.width), Int32(image.height), Int32(image.channels),
            image.width * image.channels, mask?.pixels, &options, control,
            positions.baseAddress?.assumingMemoryBound(to: Float.self), &set.scales,
            &set.orientations, &set.descriptors,
            colors.baseAddress?.assumingMemoryBound(to: UInt8.self),
            MemoryLayout<SIMD3<UInt8>>.stride, &count)
        }
      }
    }
    set.truncate(to: count)
    return set
  }

  private var kernelOptions: ck_sift_options {
    ck_sift_options(
      maximum_features: Int32(clamping: maximumFeatures), octave_layers: Int32(octaveLayers),
      first_octave: doublesPhoto ? -1 : 0,
      high_contrast_threshold: contrastThreshold * highestFactor,
      low_contrast_threshold: contrastThreshold * lowestFactor,
      sufficient_features: Int32(clamping: sufficientFeatures), edge_threshold: edgeThreshold,
      sigma: sigma, grid_cells: Int32(gridCells),
      instructions: instructions.raw)
  }
}

extension FeatureSet {
  /// Keeps the first `count` features.
  fileprivate mutating func truncate(to count: Int) {
    positions.removeLast(positions.count - count)
    scales.removeLast(scales.count - count)
    orientations.removeLast(orientations.count - count)
    descriptors.removeLast(descriptors.count - count * FeatureSet.descriptorLength)
    colors.removeLast(colors.count - count)
  }
}
