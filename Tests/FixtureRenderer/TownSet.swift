import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport

/// Writes photos of a town with noisy GPS positions, exact cameras and the surface.
struct TownSet {
  var town: TownScene
  var quality: Float = 0.9

  /// Writes `images/*.jpg`, `gt/cameras.json` and `gt/mesh.ply`. The z axis is up.
  func write(to folder: URL, _ control: KernelControl) throws {
    let truth = GroundTruth(camera: town.scene.camera, isZUp: true)
    _ = try control.parallelMap(town.scene.poses.count) { index in
      var exif = truth.exif
      exif.position = town.position(index)
      let photo = try ImageCodec.encodeJPEG(town.scene.photo(index), quality: quality)
      try writeFile(
        ExifWriter.jpeg(photo, with: exif),
        folder.appendingPathComponent("images/\(TownScene.name(index))"))
    }
    let entries = town.scene.poses.enumerated().map { truth.entry(TownScene.name($0), $1) }
    try truth.write(entries, town.scene.object, to: folder.appendingPathComponent("gt"))
  }
}
