import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport

/// Writes photos of a capture together with exact masks, and its cameras and surface in the frame
/// of the object.
struct CaptureSet {
  var scene: CaptureScene
  var quality: Float = 0.92

  /// Writes `images/*.jpg`, `masks/*.png`, `gt/cameras.json` and `gt/mesh.ply`.
  func write(to folder: URL, _ control: KernelControl) throws {
    let truth = GroundTruth(camera: scene.camera, isZUp: true)
    let names = scene.views.indices.map { RenderedScene.name($0) }
    for (index, name) in names.enumerated() {
      // One at a time, because each photo has a scene of its own.
      let photographed = scene.scene(ofPhoto: index)
      let photo = try ImageCodec.encodeJPEG(photographed.photo(index, control), quality: quality)
      try writeFile(
        ExifWriter.jpeg(photo, with: truth.exif), folder.appendingPathComponent("images/\(name)"))
      let mask = name.replacingOccurrences(of: ".jpg", with: ".png")
      try writeFile(
        ImageCodec.encodePNG(photographed.mask(index).withoutPinholes),
        folder.appendingPathComponent("masks/\(mask)"))
    }
    try truth.write(
      zip(names, scene.views).map { truth.entry($0, $1.cameraFromObject) }, scene.mesh,
      to: folder.appendingPathComponent("gt"))
  }
}

/// The sets that a command line names.
struct CaptureSelection {
  var seed: UInt64
  var objects: [CaptureObject]
  var captures: [Capture]
  var surroundings: [CaptureSurroundings]

  /// Parses `[seed] [object,…|all] [capture,…|all] [surroundings,…|all]`.
  init(_ words: [String]) throws {
    seed = try Self.seed(words.first)
    objects = try Self.cases(words.dropFirst(1).first)
    captures = try Self.cases(words.dropFirst(2).first)
    surroundings = try Self.cases(words.dropFirst(3).first)
  }

  /// Calls `body` with the scene and the name of each set.
  func forEach(_ body: (CaptureScene, String) throws -> Void) rethrows {
    for object in objects {
      for capture in captures {
        for place in surroundings {
          try body(
            CaptureScene(object, capture, place, seed: seed),
            "\(object.rawValue)-\(capture.rawValue)-\(place.rawValue)")
        }
      }
    }
  }

  /// 1 if there is no word.
  static func seed(_ word: String?) throws -> UInt64 {
    guard let word else { return 1 }
    guard let seed = UInt64(word) else { throw UnknownWord(word: word) }
    return seed
  }

  /// All cases if the word is `all`, or missing.
  static func cases<Kind: CaseIterable & RawRepresentable<String>>(
    _ word: String?, of kind: Kind.Type = Kind.self
  ) throws -> [Kind] {
    guard let word, word != "all" else { return Array(Kind.allCases) }
    return try word.split(separator: ",").map {
      guard let kind = Kind(rawValue: String($0)) else { throw UnknownWord(word: String($0)) }
      return kind
    }
  }

  struct UnknownWord: Error {
    var word: String
  }
}
