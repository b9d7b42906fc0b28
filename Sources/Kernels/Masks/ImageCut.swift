import CKernels
import SceneModel

/// Divides photos into object and surroundings by minimum cuts (Boykov and Jolly, ICCV 2001).
package struct ImageCut: Hashable, Codable, Sendable {
  /// Cost of a cut between two adjacent pixels of equal color, in log-odds; it decreases with the
  /// contrast. Measured: on axe and dtu_scan24 at 270,000 pixels, where 6 leaves holes.
  package var smoothness: Float = 12
  /// Pixels with log-odds of at least this magnitude keep their sign. Chosen.
  package var certainty: Float = 20

  package init() {}

  /// The mask with the lowest cost: 255 on the object, 0 elsewhere.
  ///
  /// `logOdds` has one number per pixel of the RGB image, positive where the pixel probably belongs
  /// to the object.
  package func mask(
    of image: RasterImage, logOdds: [Float], _ control: KernelControl
  ) throws -> RasterImage {
    guard logOdds.count == image.width * image.height else {
      throw KernelError.invalidArgument("every pixel needs its log-odds")
    }
    var result = RasterImage(width: image.width, height: image.height, channels: 1)
    var options = ck_cut_options(smoothness: smoothness, certainty: certainty)
    try withKernel(control) { control in
      image.withKernelPixels { image in
        result.withMutableKernelPixels { ck_cut_image(image, logOdds, &options, control, $0) }
      }
    }
    return result
  }
}
