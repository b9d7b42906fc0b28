import Foundation

/// A photo that passed validation.
package struct Photo: Hashable, Codable, Sendable {
  package var id: ID<Photo>
  /// The session's sample ID: the index among all files of the folder in sorted order, including
  /// rejected ones.
  package var sampleID: Int
  /// The file name relative to the input folder.
  package var name: String
  /// The file.
  package var url: URL
  /// Size in pixels after rotation upright.
  package var width: Int
  package var height: Int
  /// EXIF orientation 1…8 that rotates the stored pixels upright.
  package var orientation: Int
  package var camera: ID<Camera>
  /// Where the photo was taken; nil without GPS data.
  package var position: GeographicPosition?
  /// The mask that marks the object; nil without one.
  package var mask: PhotoMask?
  /// For a blurred photo, the number of pixels of a sharp one with the same detail; otherwise nil.
  package var sharpPixels: Int?

  package init(
    id: ID<Photo>, sampleID: Int, name: String, url: URL, width: Int, height: Int,
    orientation: Int, camera: ID<Camera>, position: GeographicPosition? = nil,
    mask: PhotoMask? = nil, sharpPixels: Int? = nil
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
    self.sharpPixels = sharpPixels
  }
}

extension Photo {
  /// The detail of the photo at a size of `pixels`, as a share of the pixels: 1 unless it is
  /// blurred.
  package func detail(at pixels: Int) -> Double {
    min(1, Double(sharpPixels ?? pixels) / Double(max(1, pixels)))
  }
}
