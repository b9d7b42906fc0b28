/// A GPS position: degrees north and east (WGS 84), meters above sea level if known.
package struct GeographicPosition: Hashable, Codable, Sendable {
  package var latitudeDegrees: Double
  package var longitudeDegrees: Double
  package var altitude: Double?

  package init(latitudeDegrees: Double, longitudeDegrees: Double, altitude: Double?) {
    self.latitudeDegrees = latitudeDegrees
    self.longitudeDegrees = longitudeDegrees
    self.altitude = altitude
  }
}
