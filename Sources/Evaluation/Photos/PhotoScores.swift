import Foundation

/// How much a picture of a model resembles a photo.
package struct PhotoScores: Codable, Hashable, Sendable {
  package var name: String
  /// Peak signal-to-noise ratio over the pixels of the mask, in decibels, after a gain of each
  /// channel that fits best: exposure and white balance are not the model's.
  package var psnr: Double
  /// Mean structural similarity of the luma (Wang et al., IEEE TIP 2004).
  package var ssim: Double
  /// Share of the mask's pixels in which the model has no surface.
  package var missing: Double
}
