import Foundation

/// The scores of several photos.
package struct PhotoScoreSummary: Codable, Hashable, Sendable {
  package var photos: [PhotoScores]
  /// Means over the photos.
  package var psnr: Double
  package var ssim: Double

  /// Nil without photos.
  init?(_ photos: [PhotoScores]) {
    guard !photos.isEmpty else { return nil }
    self.photos = photos
    psnr = photos.reduce(0) { $0 + $1.psnr } / Double(photos.count)
    ssim = photos.reduce(0) { $0 + $1.ssim } / Double(photos.count)
  }
}
