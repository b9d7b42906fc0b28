import Foundation
import SceneModel

/// COLMAP's binary format of a sparse model.
package enum COLMAPBinary {
  /// Names of the models by their numbers in files (`CameraModelId` of COLMAP's `models.h`).
  private static let modelNames = [
    "SIMPLE_PINHOLE", "PINHOLE", "SIMPLE_RADIAL", "RADIAL", "OPENCV", "OPENCV_FISHEYE",
    "FULL_OPENCV", "FOV", "SIMPLE_RADIAL_FISHEYE", "RADIAL_FISHEYE", "THIN_PRISM_FISHEYE",
    "RAD_TAN_THIN_PRISM_FISHEYE",
  ]
  /// Numbers of parameters of the models that `Camera` can represent.
  private static let parameterCounts = [
    "SIMPLE_PINHOLE": 3, "PINHOLE": 4, "SIMPLE_RADIAL": 4, "RADIAL": 5, "OPENCV": 8,
    "FULL_OPENCV": 12,
  ]

  /// Reads cameras.bin, images.bin and, if it exists, points3D.bin in `folder`, as
  /// `COLMAPText.read` does with text. Throws `FormatError` and `UnsupportedCameraModel`.
  package static func read(
    _ folder: URL, images: URL = URL(fileURLWithPath: "/")
  ) throws -> Reconstruction {
    var content = COLMAPContent()
    try parse(folder, "cameras.bin") { try addCamera($0, &$1, &content) }
    try parse(folder, "images.bin") { try addImage(&$1, &content) }
    let points = "points3D.bin"
    if FileManager.default.fileExists(atPath: folder.appendingPathComponent(points).path) {
      try parse(folder, points) { try addPoint(&$1, &content) }
    }
    return content.reconstruction(images: images)
  }

  /// Calls `entry` with the file's path for each entry of a file. Adds the path to errors.
  private static func parse(
    _ folder: URL, _ name: String, _ entry: (String, inout ByteCursor) throws -> Void
  ) throws {
    let url = folder.appendingPathComponent(name)
    var cursor = ByteCursor(try contents(of: url))
    try FormatError.naming(url) {
      for _ in 0..<(try cursor.count()) { try entry(url.path, &cursor) }
    }
  }

  private static func addCamera(
    _ path: String, _ cursor: inout ByteCursor, _ content: inout COLMAPContent
  ) throws {
    let (id, model) = (Int(try cursor.unsigned(4)), Int(try cursor.unsigned(4)))
    let (width, height) = (try cursor.count(), try cursor.count())
    let name = modelNames.indices.contains(model) ? modelNames[model] : "number \(model)"
    guard let count = parameterCounts[name] else {
      throw UnsupportedCameraModel(path: path, model: name)
    }
    let parameters = try numbers(count, &cursor)
    guard var camera = COLMAPContent.camera(name, parameters) else {
      throw UnsupportedCameraModel(path: path, model: name)
    }
    let largest = Int(Int32.max)
    guard (1...largest).contains(width), (1...largest).contains(height),
      camera.focalLength.min() > 0
    else { throw FormatFault("the size or the focal length of camera \(id) is wrong") }
    (camera.width, camera.height) = (width, height)
    content.cameras.append((id, camera))
  }

  private static func addImage(
    _ cursor: inout ByteCursor, _ content: inout COLMAPContent
  ) throws {
    let id = Int(try cursor.unsigned(4))
    let pose = COLMAPContent.pose(try numbers(7, &cursor))
    let camera = Int(try cursor.unsigned(4))
    var name: [UInt8] = []
    while case let byte = UInt8(try cursor.unsigned(1)), byte != 0 { name.append(byte) }
    var image = COLMAPContent.Image(
      id: id, camera: camera, name: String(decoding: name, as: UTF8.self), pose: pose)
    for _ in 0..<(try cursor.count()) {
      let pixel = try numbers(2, &cursor)
      image.pixels.append([pixel[0], pixel[1]])
      _ = try cursor.unsigned(8)
    }
    content.images.append(image)
  }

  private static func addPoint(
    _ cursor: inout ByteCursor, _ content: inout COLMAPContent
  ) throws {
    let id = Int(truncatingIfNeeded: try cursor.unsigned(8))
    let position = try numbers(3, &cursor)
    let color = Array(try cursor.take(3))
    let error = try numbers(1, &cursor)[0]
    var track: [(image: Int, keypoint: Int)] = []
    for _ in 0..<(try cursor.count()) {
      track.append((Int(try cursor.unsigned(4)), Int(try cursor.unsigned(4))))
    }
    let point = ScenePoint(
      position: [position[0], position[1], position[2]], color: [color[0], color[1], color[2]],
      error: error)
    content.points.append(COLMAPContent.Point(id: id, point: point, track: track))
  }

  private static func numbers(_ count: Int, _ cursor: inout ByteCursor) throws -> [Double] {
    let values = try cursor.values(Double.self, count: count)
    guard values.allSatisfy(\.isFinite) else { throw FormatFault("a number is not finite") }
    return values
  }
}
