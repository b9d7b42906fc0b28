import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport

/// Writes photos of a twin together with exact masks, cameras and surface.
struct TwinSet {
  var twin: TwinScene
  var quality: Float = 0.92

  /// Writes `images/*.jpg`, `masks/*.png`, `gt/cameras.json` and `gt/mesh.ply`, and the held-out
  /// photos with their masks to `holdout`. The z axis is up.
  func write(to folder: URL, _ control: KernelControl) throws {
    let scene = twin.scene
    let truth = GroundTruth(camera: scene.camera, isZUp: true)
    // Photos are rendered concurrently, each on one thread.
    _ = try control.parallelMap(scene.poses.count) { index in
      try write(index, truth.exif, to: folder)
    }
    let size = ", \"width\": \(scene.camera.width), \"height\": \(scene.camera.height)"
    let entries = scene.poses.enumerated().map { index, pose in
      truth.entry(
        TwinScene.name(index), pose,
        more: size + (TwinScene.isHeldOut(index) ? ", \"holdout\": true" : ""))
    }
    try truth.write(entries, scene.object, to: folder.appendingPathComponent("gt"))
  }

  private func write(_ index: Int, _ exif: ExifFields, to folder: URL) throws {
    let name = TwinScene.name(index)
    let stem = name.replacingOccurrences(of: ".jpg", with: "")
    let isHeldOut = TwinScene.isHeldOut(index)
    let photo = try ImageCodec.encodeJPEG(twin.scene.photo(index), quality: quality)
    let mask = try ImageCodec.encodePNG(twin.scene.mask(index).withoutPinholes)
    try writeFile(
      ExifWriter.jpeg(photo, with: exif),
      folder.appendingPathComponent("\(isHeldOut ? "holdout" : "images")/\(name)"))
    try writeFile(
      mask,
      folder.appendingPathComponent(isHeldOut ? "holdout/\(stem)_mask.png" : "masks/\(stem).png"))
  }
}

/// The twins that a command line names.
struct TwinSelection {
  var seed: UInt64
  var objects: [TwinObject]
  var width: Int

  /// Parses `[seed] [name,…|all] [width]`.
  init(_ words: [String]) throws {
    seed = try CaptureSelection.seed(words.first)
    objects = try CaptureSelection.cases(words.dropFirst(1).first)
    let size = words.dropFirst(2).first ?? "1000"
    guard let width = Int(size), width >= 16 else { throw CaptureSelection.UnknownWord(word: size) }
    self.width = width
  }

  /// Calls `body` with the scene and the name of each set, one after the other.
  func forEach(_ control: KernelControl, _ body: (TwinScene, String) throws -> Void) throws {
    for object in objects {
      try body(
        TwinScene(object, seed: seed, width: width, control), "\(object.rawValue)-\(seed)")
    }
  }
}
