import ImageFiles
import SceneModel

/// The initial focal length in pixels from a photo's metadata.
///
/// In order of preference: the 35 mm equivalent, the sensor width from the focal plane resolution,
/// and an assumption. Values from EXIF are typically off by a few percent; alignment refines them.
package struct FocalLengthEstimation: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Assumed focal length without metadata, as a multiple of the photo's longer side. 1.2 is a
    /// horizontal field of view of 45°, between the main cameras of phones and standard lenses.
    /// Chosen: COLMAP's default, too.
    package var assumedFactor = 1.2
    /// Width of 35 mm film in millimeters. Cameras that round the equivalent mostly compare widths,
    /// not diagonals; for 3:2 sensors there is no difference. Limit: a frame of 35 mm film is 36 ×
    /// 24 mm.
    package var filmWidth = 36.0
    /// Bounds of a plausible focal length as a multiple of the photo's longer side, and of a
    /// plausible sensor width in millimeters; metadata beyond them is ignored. Chosen.
    package var plausibleFactors = 0.2...50
    package var plausibleSensorWidths = 1.0...200
    /// Maximum difference in millimeters between the focal length and its rounded equivalent on a
    /// full-frame body. Limit: equivalents are whole millimeters.
    package var equivalentRounding = 0.5

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the focal length in pixels of a photo of the given size, and its source.
  package func run(
    _ metadata: PhotoMetadata, width: Int, height: Int
  ) -> (focalLength: Double, calibration: Camera.Calibration) {
    let side = Double(max(width, height))
    if let ratio = filmRatio(metadata) ?? sensorRatio(metadata, width, height),
      options.plausibleFactors.contains(ratio)
    {
      return (ratio * side, .exif)
    }
    return (options.assumedFactor * side, .assumed)
  }

  /// Focal length relative to the longer side, from the 35 mm equivalent.
  private func filmRatio(_ metadata: PhotoMetadata) -> Double? {
    guard let equivalent = metadata.focalLengthIn35mmFilm else { return nil }
    // For a full-frame body both focal lengths are equal, and the actual one isn't rounded.
    if let exact = metadata.focalLength, abs(exact - equivalent) <= options.equivalentRounding {
      return exact / options.filmWidth
    }
    return equivalent / options.filmWidth
  }

  /// Focal length relative to the sensor width. Resized photos keep the original size in their
  /// metadata, which the focal plane resolution refers to.
  private func sensorRatio(_ metadata: PhotoMetadata, _ width: Int, _ height: Int) -> Double? {
    guard let focalLength = metadata.focalLength,
      let resolution = metadata.focalPlaneResolution
    else { return nil }
    let original = max(metadata.originalWidth ?? width, metadata.originalHeight ?? height)
    let sensorSide = Double(original) / resolution
    return options.plausibleSensorWidths.contains(sensorSide) ? focalLength / sensorSide : nil
  }
}
