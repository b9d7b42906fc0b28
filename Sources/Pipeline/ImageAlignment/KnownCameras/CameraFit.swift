import SceneModel

/// How a camera that was made for one size of a photo goes over to the photo that is there.
struct CameraFit: Hashable {
  /// The camera of the upright photo.
  private(set) var camera: Camera
  /// Quarter turns clockwise from the photo that the camera was made for to the upright one.
  private(set) var quarterTurns = 0
  /// Pixels of the photo for one pixel of the camera, after the turns.
  private(set) var scale = SIMD2(1.0, 1.0)
  /// Size that the camera was made for.
  private let original: SIMD2<Double>

  /// Nil where the camera is for a photo of another shape.
  init?(_ camera: Camera, to photo: Photo, isSizeKnown: Bool) {
    var camera = camera
    if !isSizeKnown {
      guard let size = Self.size(camera.principalPoint, photo) else { return nil }
      (camera.width, camera.height) = size
    }
    self.camera = camera
    original = [Double(camera.width), Double(camera.height)]
    if !Self.agree(camera, photo), let turns = [6: 1, 8: 3][photo.orientation] {
      for _ in 0..<turns { self.camera = self.camera.turnedClockwise() }
      quarterTurns = turns
    }
    guard Self.agree(self.camera, photo) else { return nil }
    scale = [
      Double(photo.width) / Double(self.camera.width),
      Double(photo.height) / Double(self.camera.height),
    ]
    self.camera = self.camera.resized(width: photo.width, height: photo.height)
  }

  /// The size, of the upright or of the stored photo, that has the principal point nearer to its
  /// middle; nil where it is far from both.
  private static func size(
    _ principalPoint: SIMD2<Double>, _ photo: Photo
  ) -> (width: Int, height: Int)? {
    func offset(_ width: Int, _ height: Int) -> Double {
      let place = principalPoint / SIMD2(Double(width), Double(height))
      return max(abs(place.x - 0.5), abs(place.y - 0.5))
    }
    let upright = offset(photo.width, photo.height)
    let stored = photo.orientation > 4 ? offset(photo.height, photo.width) : .infinity
    guard min(upright, stored) < 0.2 else { return nil }
    return upright <= stored ? (photo.width, photo.height) : (photo.height, photo.width)
  }

  /// Whether the shapes agree, up to a pixel of the smaller of the two.
  private static func agree(_ camera: Camera, _ photo: Photo) -> Bool {
    let (w, h) = (Double(camera.width), Double(camera.height))
    let (width, height) = (Double(photo.width), Double(photo.height))
    return abs(w * height - h * width) <= max(w, width, h, height)
  }

  /// Whether the photo has another size than the camera was made for.
  var isScaled: Bool { scale != [1, 1] }

  /// The pose of the upright photo; the world doesn't move.
  func pose(_ cameraFromWorld: RigidTransform) -> RigidTransform {
    guard quarterTurns > 0 else { return cameraFromWorld }
    let turn = Quaternion(angle: Double(quarterTurns) * .pi / 2, axis: [0, 0, 1])
    return RigidTransform(rotation: turn, translation: .zero) * cameraFromWorld
  }

  /// The place in the upright photo of a pixel of the photo that the camera was made for.
  func pixel(_ pixel: SIMD2<Double>) -> SIMD2<Double> {
    var (result, size) = (pixel, original)
    for _ in 0..<quarterTurns {
      result = [size.y - result.y, result.x]
      size = [size.y, size.x]
    }
    return result * scale
  }
}

extension Camera {
  /// The camera of the photo turned by a quarter clockwise, in which x is the old −y and y the old x.
  func turnedClockwise() -> Camera {
    Camera(
      width: height, height: width, focalLength: [focalLength.y, focalLength.x],
      principalPoint: [Double(height) - principalPoint.y, principalPoint.x],
      distortion: [distortion.x, distortion.y, distortion.w, -distortion.z],
      calibration: calibration)
  }
}
