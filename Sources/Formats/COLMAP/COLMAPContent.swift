import Foundation
import SceneModel

/// What COLMAP's files of a model contain, with COLMAP's ids.
struct COLMAPContent {
  struct Image {
    var id: Int
    var camera: Int
    var name: String
    var pose: RigidTransform
    var pixels: [SIMD2<Double>] = []
  }

  struct Point {
    var id: Int
    var point: ScenePoint
    /// Image ids and keypoint indices.
    var track: [(image: Int, keypoint: Int)]
  }

  var cameras: [(id: Int, camera: Camera)] = []
  var images: [Image] = []
  var points: [Point] = []

  /// The camera from a model's parameters, without its size; nil if `Camera` can't represent it.
  static func camera(_ model: String, _ p: [Double]) -> Camera? {
    var camera = Camera(width: 0, height: 0, focalLength: .zero, calibration: .refined)
    switch (model, p.count) {
    case ("SIMPLE_PINHOLE", 3), ("SIMPLE_RADIAL", 4), ("RADIAL", 5):
      camera.focalLength = [p[0], p[0]]
      camera.principalPoint = [p[1], p[2]]
      camera.distortion = [p.count > 3 ? p[3] : 0, p.count > 4 ? p[4] : 0, 0, 0]
    case ("PINHOLE", 4), ("OPENCV", 8), ("FULL_OPENCV", 12):
      guard p.dropFirst(8).allSatisfy({ $0 == 0 }) else { return nil }
      camera.focalLength = [p[0], p[1]]
      camera.principalPoint = [p[2], p[3]]
      if p.count >= 8 { camera.distortion = [p[4], p[5], p[6], p[7]] }
    default: return nil
    }
    return camera
  }

  /// COLMAP's models that `Camera` can't represent, with their parameter counts.
  static let unsupportedModels = [
    "OPENCV_FISHEYE": 8, "FULL_OPENCV": 12, "FOV": 5, "SIMPLE_RADIAL_FISHEYE": 4,
    "RADIAL_FISHEYE": 5, "THIN_PRISM_FISHEYE": 12, "RAD_TAN_THIN_PRISM_FISHEYE": 16,
    "SIMPLE_DIVISION": 4, "DIVISION": 5, "SIMPLE_FISHEYE": 3, "FISHEYE": 4, "EQUIRECTANGULAR": 2,
  ]

  /// The pose of seven numbers: the quaternion w, x, y, z and the translation.
  static func pose(_ p: [Double]) -> RigidTransform {
    // A quaternion that this program wrote has unit length up to rounding and stays as it is.
    let rotation = Quaternion(x: p[1], y: p[2], z: p[3], w: p[0])
    let length = p[0..<4].reduce(0) { $0 + $1 * $1 }
    return RigidTransform(
      rotation: abs(length - 1) < 1e-14 ? rotation : rotation.normalized,
      translation: [p[4], p[5], p[6]])
  }

  /// Converts the ids to indices; references to missing entries are dropped.
  func reconstruction(images imageFolder: URL) -> Reconstruction {
    let cameras = self.cameras.sorted { $0.id < $1.id }
    let cameraIDs = Dictionary(
      cameras.enumerated().map { ($1.id, ID<Camera>($0)) }, uniquingKeysWith: { first, _ in first })
    let images = self.images.sorted { $0.id < $1.id }.filter { cameraIDs[$0.camera] != nil }
    let indices = Dictionary(
      images.enumerated().map { ($1.id, $0) }, uniquingKeysWith: { first, _ in first })
    var photos: [Photo] = []
    for (index, image) in images.enumerated() {
      guard let camera = cameraIDs[image.camera] else { continue }
      let size = cameras[camera.index].camera
      photos.append(
        Photo(
          id: ID(index), sampleID: index, name: image.name,
          url: imageFolder.appendingPathComponent(image.name), width: size.width,
          height: size.height, orientation: 1, camera: camera))
    }
    let points = self.points.sorted { $0.id < $1.id }.map { entry in
      var point = entry.point
      point.track = entry.track.compactMap { observation in
        guard let index = indices[observation.image],
          images[index].pixels.indices.contains(observation.keypoint)
        else { return nil }
        return Observation(
          photo: ID(index), feature: Int32(observation.keypoint),
          pixel: images[index].pixels[observation.keypoint])
      }.sorted { $0.photo < $1.photo }
      return point
    }
    return Reconstruction(
      cameras: cameras.map(\.camera), photos: photos, poses: images.map(\.pose), points: points)
  }
}
