import Formats
import Foundation
import ImageFiles
import SceneModel
import TestSupport

/// The text and metadata of a photo set: exact cameras and surface, in a y-up or a z-up frame.
struct GroundTruth {
  var camera: Camera
  /// Writes cameras and surface in a z-up frame instead of a y-up one.
  var isZUp: Bool

  /// Camera model and focal length.
  var exif: ExifFields { ExifFields(rendering: camera) }

  /// An object of name, K, R and t: `x_camera = R x_world + t`, x right, y down, z forward, pixel
  /// origin at the top-left corner of the top-left pixel.
  func entry(_ name: String, _ pose: RigidTransform, more: String = "") -> String {
    let k = [
      [camera.focalLength.x, 0, camera.principalPoint.x],
      [0, camera.focalLength.y, camera.principalPoint.y], [0, 0, 1],
    ]
    let m = pose.rotation.matrix
    let r = [m.row0, m.row1, m.row2].map { isZUp ? [$0.x, -$0.z, $0.y] : [$0.x, $0.y, $0.z] }
    let t = [pose.translation.x, pose.translation.y, pose.translation.z]
    return "{\"name\": \"\(name)\", \"K\": \(k), \"R\": \(r), \"t\": \(t)\(more)}"
  }

  /// Writes `cameras.json`, a list of entries, and `mesh.ply`.
  func write(_ entries: [String], _ mesh: Mesh, to folder: URL) throws {
    let text = "[\n" + entries.joined(separator: ",\n") + "\n]\n"
    try writeFile(Array(text.utf8), folder.appendingPathComponent("cameras.json"))
    var mesh = mesh
    mesh.normals = []
    if isZUp { mesh.positions = mesh.positions.map { SIMD3($0.x, -$0.z, $0.y) } }
    try writeFile(PLY.encode(mesh), folder.appendingPathComponent("mesh.ply"))
  }
}
