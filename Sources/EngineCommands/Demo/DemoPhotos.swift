import Formats
import Foundation
import ImageFiles
import Kernels
import SceneRendering

/// The photos of the demo: a statue on a table, rendered.
struct DemoPhotos {
  let scene: RenderedScene

  init() {
    var scene = RenderedScene.statue()
    // A lens, and fewer rays where the photo is smooth.
    scene.photography = Photography()
    self.scene = scene
  }

  var count: Int { scene.poses.count }

  /// Writes the photos into the folder `photos`, with the focal length in their EXIF data.
  func write(to photos: URL, _ control: KernelControl) throws {
    let exif = ExifFields(rendering: scene.camera)
    for index in 0..<count {
      let part = control.part(
        from: Double(index) / Double(count), to: Double(index + 1) / Double(count))
      let jpeg = try ImageCodec.encodeJPEG(scene.photo(index, part), quality: 0.92)
      try AtomicFile.write(
        Data(ExifWriter.jpeg(jpeg, with: exif)),
        to: photos.appendingPathComponent(DemoFolder.photoName(index)))
    }
  }
}
