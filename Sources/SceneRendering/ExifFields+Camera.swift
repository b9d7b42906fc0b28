import ImageFiles
import SceneModel

extension ExifFields {
  /// The camera model and the focal length of rendered photos, as for a full-frame sensor, 36 mm
  /// wide.
  package init(rendering camera: Camera) {
    self.init()
    let tenths = UInt32((camera.focalLength.x / Double(camera.width) * 360).rounded())
    make = "Rendered"
    model = "Pinhole"
    focalLength = (tenths, 10)
    focalLengthIn35mmFilm = Int((Double(tenths) / 10).rounded())
  }
}
