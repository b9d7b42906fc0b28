import Foundation
import SceneModel

/// Cameras that Metashape and its predecessor PhotoScan export as XML.
///
/// The layout is that of "Export Cameras": `<document><chunk>` with `<sensors>`, `<cameras>` and
/// the transform of the chunk. A camera's `<transform>` takes camera coordinates (x right, y down,
/// z forward) to those of the chunk (Metashape User Manual, appendix "Camera models").
package enum MetashapeCameras {
  /// Reads the cameras that have a pose, in the coordinates of the chunk's transform if there is
  /// one. Of the lens, k1, k2, p1 and p2 are kept; k3, k4 and b2 are dropped.
  ///
  /// Photos are named by their labels, in the order of the file. Throws a `FormatError`.
  package static func read(_ url: URL) throws -> Reconstruction {
    let bytes = try contents(of: url)
    return try FormatError.naming(url) { try decode(bytes) }
  }

  static func decode(_ bytes: [UInt8]) throws -> Reconstruction {
    let document = try XMLElement.parse(bytes)
    guard document.name == "document", let chunk = document.child("chunk") else {
      throw FormatFault("it has no <document> with a <chunk>")
    }
    let sensors = try Sensors(chunk)
    let worldFromChunk = try chunk.child("transform").map(worldFromChunk) ?? .identity
    var result = Reconstruction(cameras: sensors.cameras, photos: [], poses: [], points: [])
    // Cameras may be in groups.
    let cameras = chunk.child("cameras")
    for group in [cameras].compactMap({ $0 }) + (cameras?.children("group") ?? []) {
      for element in group.children("camera") {
        guard let transform = element.child("transform") else { continue }
        let label = element.attributes["label"] ?? ""
        guard let numbers = transform.numbers, let chunkFromCamera = rigid(numbers) else {
          throw FormatFault("the transform of camera \(label) is no rotation and translation")
        }
        guard let camera = sensors.ids[element.attributes["sensor_id"] ?? ""] else {
          throw FormatFault("the sensor of camera \(label) has no calibration")
        }
        let size = sensors.cameras[camera.index]
        result.photos.append(
          Photo(
            id: ID(result.photos.count), sampleID: result.photos.count, name: label,
            url: URL(fileURLWithPath: "/" + label), width: size.width, height: size.height,
            orientation: 1, camera: camera))
        let pose = worldFromChunk.applied(toCameraFromA: chunkFromCamera.inverse)
        result.poses.append(pose)
      }
    }
    return result
  }

  /// The similarity in `<rotation>`, `<translation>` and `<scale>`.
  private static func worldFromChunk(_ transform: XMLElement) throws -> SimilarityTransform {
    guard let rotation = transform.child("rotation")?.numbers,
      let translation = transform.child("translation")?.numbers,
      let rigid = rigid(rotation: rotation, translation: translation),
      case let scale = transform.number("scale") ?? 1, scale > 0
    else { throw FormatFault("the transform of the chunk is no similarity") }
    return SimilarityTransform(
      scale: scale, rotation: rigid.rotation, translation: rigid.translation)
  }

  /// The transform of a matrix of 16 numbers, row by row.
  private static func rigid(_ m: [Double]) -> RigidTransform? {
    guard m.count == 16 else { return nil }
    return rigid(
      rotation: [m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]],
      translation: [m[3], m[7], m[11]])
  }

  private static func rigid(rotation r: [Double], translation t: [Double]) -> RigidTransform? {
    guard r.count == 9, t.count == 3 else { return nil }
    let rows = stride(from: 0, to: 9, by: 3).map { SIMD3(r[$0], r[$0 + 1], r[$0 + 2]) }
    // Numbers are rounded. Chosen: PhotoScan 0.9 wrote six digits.
    let tolerance = 1e-3
    for i in 0..<3 {
      for j in 0..<3 where abs(rows[i].dot(rows[j]) - (i == j ? 1 : 0)) > tolerance { return nil }
    }
    guard rows[0].cross(rows[1]).dot(rows[2]) > 0 else { return nil }
    return RigidTransform(
      rotation: Quaternion(Matrix3(rows: rows[0], rows[1], rows[2])),
      translation: [t[0], t[1], t[2]])
  }
}

/// The calibrated sensors of a chunk.
private struct Sensors {
  var cameras: [Camera] = []
  /// By the sensor's id in the file.
  var ids: [String: ID<Camera>] = [:]

  init(_ chunk: XMLElement) throws {
    for sensor in chunk.child("sensors")?.children("sensor") ?? [] {
      let calibrations = sensor.children("calibration")
      let adjusted = calibrations.last { $0.attributes["class"] == "adjusted" }
      guard let calibration = adjusted ?? calibrations.last else { continue }
      ids[sensor.attributes["id"] ?? ""] = ID(cameras.count)
      cameras.append(try Self.camera(calibration, sensor))
    }
  }

  private static func camera(_ calibration: XMLElement, _ sensor: XMLElement) throws -> Camera {
    let resolution = calibration.child("resolution") ?? sensor.child("resolution")
    let largest = Int(Int32.max)
    guard let width = resolution?.attributes["width"].flatMap(Int.init),
      let height = resolution?.attributes["height"].flatMap(Int.init),
      (1...largest).contains(width), (1...largest).contains(height)
    else { throw FormatFault("a sensor has no resolution") }
    var camera = Camera(width: width, height: height, focalLength: .zero, calibration: .refined)
    if let f = calibration.number("f") {
      // Since Metashape 1.2: the principal point is relative to the center.
      camera.focalLength = [f + (calibration.number("b1") ?? 0), f]
      camera.principalPoint += [calibration.number("cx") ?? 0, calibration.number("cy") ?? 0]
    } else if let fx = calibration.number("fx") {
      camera.focalLength = [fx, calibration.number("fy") ?? fx]
      camera.principalPoint = [
        calibration.number("cx") ?? Double(width) / 2,
        calibration.number("cy") ?? Double(height) / 2,
      ]
    }
    guard camera.focalLength.min() > 0 else { throw FormatFault("a sensor has no focal length") }
    // Metashape's p1 and p2 are OpenCV's p2 and p1.
    let terms = ["k1", "k2", "p2", "p1"].map { calibration.number($0) ?? 0 }
    camera.distortion = SIMD4(terms[0], terms[1], terms[2], terms[3])
    return camera
  }
}
