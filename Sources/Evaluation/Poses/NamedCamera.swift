import Foundation
import SceneModel

/// A photo's camera and pose, identified by the photo's name.
package struct NamedCamera: Hashable, Sendable {
  package var name: String
  package var camera: Camera
  package var cameraFromWorld: RigidTransform
  /// Whether the camera's width and height are those of the photo rather than a guess.
  package var isSizeKnown: Bool
  /// Whether the photo was held out of the input, to be compared with the model.
  package var isHeldOut = false

  package init(
    name: String, camera: Camera, cameraFromWorld: RigidTransform, isSizeKnown: Bool = true
  ) {
    self.name = name
    self.camera = camera
    self.cameraFromWorld = cameraFromWorld
    self.isSizeKnown = isSizeKnown
  }
}

extension NamedCamera {
  /// Maximum deviation of a rotation matrix from orthonormality, and maximum skew relative to the
  /// focal length: files may contain rounded numbers. Chosen.
  private static let rounding = 1e-3
  /// Maximum width and height of a photo in pixels. Chosen: JPEG ends at 65,535, and sizes in files
  /// may be of stitched photos.
  private static let maximumSide = 1_000_000

  /// The registered photos of a reconstruction.
  package static func cameras(of reconstruction: Reconstruction) -> [NamedCamera] {
    reconstruction.registered.compactMap { id in
      reconstruction.poses[id.index].map {
        NamedCamera(
          name: reconstruction.photos[id.index].name, camera: reconstruction.camera(of: id),
          cameraFromWorld: $0)
      }
    }
  }

  /// Reads a list of `{"name", "K", "R", "t"}`: calibration matrix, rotation and translation of
  /// `x_camera = R x_world + t`.
  ///
  /// If an entry doesn't specify `"width"` and `"height"`, they are assumed to be twice the
  /// principal point, up to `maximumSide`. Throws `EvaluationError.invalidReference`.
  package static func cameras(json data: Data) throws -> [NamedCamera] {
    let entries: [Entry]
    do {
      entries = try JSONDecoder().decode([Entry].self, from: data)
    } catch {
      throw EvaluationError.invalidReference(
        "it is not a list of cameras with name, K, R and t")
    }
    return try entries.map { try NamedCamera($0) }
  }

  private struct Entry: Decodable {
    var name: String
    var K: [[Double]]
    var R: [[Double]]
    var t: [Double]
    var holdout: Bool?
    var width: Int?
    var height: Int?
  }

  private init(_ entry: Entry) throws {
    guard Self.isMatrix(entry.K), Self.isMatrix(entry.R), entry.t.count == 3,
      entry.t.allSatisfy(\.isFinite)
    else {
      throw EvaluationError.invalidReference("the matrices of \(entry.name) are not 3 × 3")
    }
    guard Self.isRotation(entry.R) else {
      throw EvaluationError.invalidReference("R of \(entry.name) is not a rotation")
    }
    guard entry.K[0][0] > 0, entry.K[1][1] > 0,
      abs(entry.K[0][1]) < Self.rounding * entry.K[0][0]
    else {
      throw EvaluationError.invalidReference(
        "K of \(entry.name) has skew or a non-positive focal length")
    }
    let (k, r) = (entry.K, entry.R.map { SIMD3($0[0], $0[1], $0[2]) })
    let width = entry.width ?? Int(saturating: 2 * k[0][2])
    let height = entry.height ?? Int(saturating: 2 * k[1][2])
    guard max(width, height) <= Self.maximumSide else {
      throw EvaluationError.invalidReference(
        "\(entry.name) can't have \(width) × \(height) pixels, by its width and height or else "
          + "by the principal point in K; correct them")
    }
    self.init(
      name: entry.name,
      camera: Camera(
        width: width, height: height, focalLength: [k[0][0], k[1][1]],
        principalPoint: [k[0][2], k[1][2]], calibration: .refined),
      cameraFromWorld: RigidTransform(
        rotation: Quaternion(Matrix3(rows: r[0], r[1], r[2])),
        translation: [entry.t[0], entry.t[1], entry.t[2]]),
      isSizeKnown: (entry.width ?? 0) > 0 && (entry.height ?? 0) > 0)
    isHeldOut = entry.holdout == true
  }

  private static func isMatrix(_ rows: [[Double]]) -> Bool {
    rows.count == 3 && rows.allSatisfy { $0.count == 3 && $0.allSatisfy(\.isFinite) }
  }

  private static func isRotation(_ rows: [[Double]]) -> Bool {
    let r = rows.map { SIMD3($0[0], $0[1], $0[2]) }
    let isOrthonormal = (0..<3).allSatisfy { i in
      (0..<3).allSatisfy { abs(r[i].dot(r[$0]) - (i == $0 ? 1 : 0)) < rounding }
    }
    return isOrthonormal && r[0].cross(r[1]).dot(r[2]) > 0
  }
}
