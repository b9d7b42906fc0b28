/// A measured distance in the scene.
package struct KnownDistance: Hashable, Codable, Sendable {
  /// A point of the scene in one photo: pixels of the upright photo at full size, as image viewers
  /// display it, origin at the top-left corner.
  package struct Pick: Hashable, Codable, Sendable {
    package var photo: String
    package var x: Double
    package var y: Double

    package init(photo: String, x: Double, y: Double) {
      (self.photo, self.x, self.y) = (photo, x, y)
    }
  }

  /// One end of the distance.
  package enum End: Hashable, Codable, Sendable {
    /// The center of the camera that took the photo with this file name.
    case camera(String)
    /// A point picked in at least two photos.
    case point([Pick])

    /// The file names of the photos that it refers to.
    package var photos: [String] {
      switch self {
      case .camera(let name): [name]
      case .point(let picks): picks.map(\.photo)
      }
    }
  }

  /// Lengths from that of a bacterium to that of a country. Chosen: beyond them, the numbers of a
  /// model in meters would be out of range.
  package static let possibleMeters = 1e-6...1e6
  /// Completes the sentence "A distance must be …".
  package static let possibleMetersText = "from 0.000001 to 1000000 m"

  package var from: End
  package var to: End
  /// The length in meters.
  package var meters: Double

  package init(from: End, to: End, meters: Double) {
    (self.from, self.to, self.meters) = (from, to, meters)
  }
}
