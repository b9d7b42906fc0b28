import Foundation

/// A photo that passed validation.
package struct Photo: Hashable, Codable, Sendable {
  package var id: ID<Photo>
  /// The session's sample id: the index among all files of the folder in sorted order, the refused
  /// ones included.
  package var sampleID: Int
  /// The file's name relative to the input folder.
  package var name: String
  package var url: URL
  /// Size in pixels of the stored photo turned upright.
  package var width: Int
  package var height: Int
  /// EXIF orientation 1…8 that turns the stored pixels upright.
  package var orientation: Int
  package var camera: ID<Camera>
  package var position: GeographicPosition?
  /// Which of its pixels show the object; nil where nothing tells.
  package var mask: PhotoMask?

  package init(
    id: ID<Photo>, sampleID: Int, name: String, url: URL, width: Int, height: Int,
    orientation: Int, camera: ID<Camera>, position: GeographicPosition? = nil,
    mask: PhotoMask? = nil
  ) {
    self.id = id
    self.sampleID = sampleID
    self.name = name
    self.url = url
    self.width = width
    self.height = height
    self.orientation = orientation
    self.camera = camera
    self.position = position
    self.mask = mask
  }
}

/// A GPS position: degrees north and east (WGS 84), metres above the sea when known.
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

/// A file of the input that is not used, and why.
package struct RefusedPhoto: Hashable, Codable, Sendable {
  /// What kind of fault it is.
  package enum Fault: String, Hashable, Codable, Sendable {
    case unreadable, unsupportedFormat, tooSmall, tooLarge, blurred, duplicate, tooMany
    case notRegistered
  }

  package var sampleID: Int
  package var name: String
  package var fault: Fault
  /// A sentence for the user that names the reason and, where there is one, the remedy.
  package var reason: String

  package init(sampleID: Int, name: String, fault: Fault, reason: String) {
    self.sampleID = sampleID
    self.name = name
    self.fault = fault
    self.reason = reason
  }
}
