import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport

/// Writes photos of a rendered scene together with its cameras and surface.
struct PhotoSet {
  var scene: RenderedScene
  /// Writes camera model and focal length into the photos.
  var hasMetadata = true
  var quality: Float
  /// Writes cameras and surface in a z-up frame instead of a y-up one.
  var isZUp = false
  /// The scene from other poses, for comparison with a model: photos that are not in `images`.
  var held: RenderedScene?

  /// Writes `images/*.jpg`, `gt/cameras.json` and `gt/mesh.ply`, and the held-out photos with masks
  /// of the object to `holdout`.
  func write(to folder: URL, _ control: KernelControl) throws {
    for index in scene.poses.indices {
      var bytes = try ImageCodec.encodeJPEG(scene.photo(index, control), quality: quality)
      if hasMetadata { bytes = ExifWriter.jpeg(bytes, with: truth.exif) }
      try writeFile(bytes, folder.appendingPathComponent("images/\(RenderedScene.name(index))"))
    }
    try writeHeld(to: folder.appendingPathComponent("holdout"), control)
    try truth.write(entries, scene.object, to: folder.appendingPathComponent("gt"))
  }

  private func writeHeld(to folder: URL, _ control: KernelControl) throws {
    guard let held else { return }
    for index in held.poses.indices {
      let name = Self.heldName(index)
      try writeFile(
        ImageCodec.encodePNG(held.photo(index, control)), folder.appendingPathComponent(name))
      try writeFile(
        ImageCodec.encodePNG(held.mask(index)),
        folder.appendingPathComponent(name.replacingOccurrences(of: ".png", with: "_mask.png")))
    }
  }

  private static func heldName(_ index: Int) -> String { "held_\(index).png" }

  private var truth: GroundTruth { GroundTruth(camera: scene.camera, isZUp: isZUp) }

  private var entries: [String] {
    var entries = scene.poses.enumerated().map { truth.entry(RenderedScene.name($0), $1) }
    if let held {
      let truth = GroundTruth(camera: held.camera, isZUp: isZUp)
      entries += held.poses.enumerated().map {
        truth.entry(Self.heldName($0), $1, more: ", \"holdout\": true")
      }
    }
    return entries
  }
}

func writeFile(_ bytes: [UInt8], _ url: URL) throws {
  try FileManager.default.createDirectory(
    at: url.deletingLastPathComponent(), withIntermediateDirectories: true)
  try Data(bytes).write(to: url)
}
