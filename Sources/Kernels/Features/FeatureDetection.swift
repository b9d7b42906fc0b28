import CKernels
import SceneModel

/// SIFT detector with root-SIFT descriptors (Lowe, IJCV 2004; Arandjelović and Zisserman, CVPR
/// 2012).
package struct FeatureDetection: Hashable, Codable, Sendable {
  /// Maximum number of features, the strongest of each grid cell. Chosen.
  package var maximumFeatures = 8000
  /// Lowe's contrast threshold for intensities 0…1. Chosen: lower than the 0.03 of Lowe 2004,
  /// section 4.
  package var contrastThreshold = 0.02
  /// Bounds of a factor on the contrast threshold; the highest factor that still yields
  /// `sufficientFeatures` is used. Chosen.
  package var lowestFactor = 0.8
  package var highestFactor = 1.2
  /// Sufficient number of features of a photo. Chosen.
  package var sufficientFeatures = 6000
  /// Lowe's limit on the ratio of principal curvatures. Paper: Lowe 2004, section 4.1.
  package var edgeThreshold = 10.0
  /// Whether the first octave is the photo upsampled to twice its size, which detects small
  /// features, or the photo itself.
  package var doublesPhoto = true
  /// Scale samples per octave. Paper: Lowe 2004, section 3.2.
  package var octaveLayers = 3
  /// Gaussian blur of the first layer in pixels. Paper: Lowe 2004, section 3.3.
  package var sigma = 1.6
  /// Grid cells along the longer side, over which the features are balanced. Chosen.
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
    if let mask, !mask.isGray(ofTheSizeOf: image) {
      throw KernelError.invalidArgument("the mask is not gray or not of the image's size")
    }
    let output = DetectedFeatures(capacity: maximumFeatures)
    var (options, raw) = (kernelOptions, output.raw)
    var count = 0
    try withExtendedLifetime(output) {
      try withKernel(control) { control in
        image.withKernelPixels {
          ck_sift_detect($0, mask?.pixels, &options, control, &raw, &count)
        }
      }
    }
    return output.features(count)
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

/// The memory that the kernel writes features to.
private struct DetectedFeatures {
  private let positions: KernelArray<SIMD2<Float>>
  private let scales: KernelArray<Float>
  private let orientations: KernelArray<Float>
  private let descriptors: KernelArray<UInt8>
  private let colors: KernelArray<SIMD3<UInt8>>

  init(capacity: Int) {
    positions = KernelArray(repeatElement(.zero, count: capacity))
    scales = KernelArray(repeatElement(0, count: capacity))
    orientations = KernelArray(repeatElement(0, count: capacity))
    descriptors = KernelArray(repeatElement(0, count: capacity * FeatureSet.descriptorLength))
    colors = KernelArray(repeatElement(.zero, count: capacity))
  }

  /// Valid as long as the memory lives.
  var raw: ck_sift_output {
    ck_sift_output(
      positions: UnsafeMutableRawPointer(positions.base)?.assumingMemoryBound(to: Float.self),
      scales: scales.base, orientations: orientations.base, descriptors: descriptors.base,
      colors: colors.mutableSpan)
  }

  /// The first `count` features.
  func features(_ count: Int) -> FeatureSet {
    FeatureSet(
      positions: Array(positions.elements.prefix(count)),
      scales: Array(scales.elements.prefix(count)),
      orientations: Array(orientations.elements.prefix(count)),
      descriptors: Array(descriptors.elements.prefix(count * FeatureSet.descriptorLength)),
      colors: Array(colors.elements.prefix(count)))
  }
}
