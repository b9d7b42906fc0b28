/// The metadata that `ExifWriter` writes into a photo; nil fields are left out.
package struct ExifFields: Sendable {
  package var orientation: Int?
  package var make: String?
  package var model: String?
  /// Millimeters as numerator and denominator, so that invalid values can also be written.
  package var focalLength: (UInt32, UInt32)?
  package var focalLengthIn35mmFilm: Int?
  /// Pixels per inch on the sensor, as numerator and denominator.
  package var focalPlaneResolution: (UInt32, UInt32)?
  package var originalSize: (width: Int, height: Int)?
  /// Degrees north and east, and meters.
  package var position: (latitude: Double, longitude: Double, altitude: Double)?

  package init() {}
}
