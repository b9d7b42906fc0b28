import Formats
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
      if hasMetadata { bytes = ExifWriter.jpeg(bytes, with: exif) }
      try writeFile(bytes, folder.appendingPathComponent("images/\(RenderedScene.name(index))"))
    }
    try writeHeld(to: folder.appendingPathComponent("holdout"), control)
    try writeFile(Array(camerasJSON.utf8), folder.appendingPathComponent("gt/cameras.json"))
    var mesh = scene.object
    mesh.normals = []
    if isZUp { mesh.positions = mesh.positions.map { SIMD3($0.x, -$0.z, $0.y) } }
    try writeFile(PLY.encode(mesh), folder.appendingPathComponent("gt/mesh.ply"))
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

  /// As for a full-frame sensor, 36 mm wide.
  private var exif: ExifFields {
    let camera = scene.camera
    let tenths = UInt32((camera.focalLength.x / Double(camera.width) * 360).rounded())
    var exif = ExifFields()
    exif.make = "Rendered"
    exif.model = "Pinhole"
    exif.focalLength = (tenths, 10)
    exif.focalLengthIn35mmFilm = Int((Double(tenths) / 10).rounded())
    return exif
  }

  /// A list of name, K, R and t: `x_camera = R x_world + t`, x right, y down, z forward, pixel
  /// origin at the top-left corner of the top-left pixel.
  private var camerasJSON: String {
    var entries = scene.poses.enumerated().map {
      entry(RenderedScene.name($0), $1, of: scene.camera)
    }
    if let held {
      entries += held.poses.enumerated().map {
        entry(Self.heldName($0), $1, of: held.camera, more: ", \"holdout\": true")
      }
    }
    return "[\n" + entries.joined(separator: ",\n") + "\n]\n"
  }

  private func entry(
    _ name: String, _ pose: RigidTransform, of camera: Camera, more: String = ""
  ) -> String {
    let k = [
      [camera.focalLength.x, 0, camera.principalPoint.x],
      [0, camera.focalLength.y, camera.principalPoint.y], [0, 0, 1],
    ]
    let m = pose.rotation.matrix
    let r = [m.row0, m.row1, m.row2].map { isZUp ? [$0.x, -$0.z, $0.y] : [$0.x, $0.y, $0.z] }
    let t = [pose.translation.x, pose.translation.y, pose.translation.z]
    return "{\"name\": \"\(name)\", \"K\": \(k), \"R\": \(r), \"t\": \(t)\(more)}"
  }
}

func writeFile(_ bytes: [UInt8], _ url: URL) throws {
  try FileManager.default.createDirectory(
    at: url.deletingLastPathComponent(), withIntermediateDirectories: true)
  try Data(bytes).write(to: url)
}
