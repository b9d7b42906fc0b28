import ImageFiles
import SceneModel

/// The focal length in pixels from a photo's metadata.
///
/// In this order: the 35 mm equivalent, the sensor's width from the focal plane resolution, and an
/// assumption. EXIF lengths are a few percent off as a rule, so that alignment refines them.
package struct FocalLengthEstimation: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Focal length where nothing is known, as a multiple of the photo's longer side. 1.2 is a
    /// horizontal field of view of 45°, between the main cameras of phones and standard lenses.
    package var assumedFactor = 1.2
    /// Width in millimetres of 35 mm film. Cameras that round the equivalent mostly compare widths,
    /// not diagonals; for sensors of the shape 3:2 there is no difference.
    package var filmWidth = 36.0

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Pixels, and whether they come from the metadata; the size is the photo's.
  package func run(
    _ metadata: PhotoMetadata, width: Int, height: Int
  ) -> (focalLength: Double, calibration: Camera.Calibration) {
    let side = Double(max(width, height))
    if let ratio = filmRatio(metadata) ?? sensorRatio(metadata, width, height),
      (0.2...50).contains(ratio)
    {
      return (ratio * side, .exif)
    }
    return (options.assumedFactor * side, .assumed)
  }

  private func filmRatio(_ metadata: PhotoMetadata) -> Double? {
    guard let equivalent = metadata.focalLengthIn35mmFilm else { return nil }
    // On a full-frame body both lengths are the same, and the true one isn't rounded.
    if let exact = metadata.focalLength, abs(exact - equivalent) <= 0.5 {
      return exact / options.filmWidth
    }
    return equivalent / options.filmWidth
  }

  /// Focal length by sensor width. Resized photos keep the size that the resolution belongs to.
  private func sensorRatio(_ metadata: PhotoMetadata, _ width: Int, _ height: Int) -> Double? {
    guard let focalLength = metadata.focalLength,
      let resolution = metadata.focalPlaneResolution
    else { return nil }
    let original = max(metadata.originalWidth ?? width, metadata.originalHeight ?? height)
    let sensorSide = Double(original) / resolution
    return (1...200).contains(sensorSide) ? focalLength / sensorSide : nil
  }
}
