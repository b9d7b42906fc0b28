import SceneModel

/// The conversion of a camera that was estimated for one size or orientation of a photo to the
/// photo at hand.
struct CameraFit: Hashable {
  /// Maximum distance of the principal point from the center, as a fraction of the photo's width or
  /// height, for a camera of unknown size. Chosen.
  private static let maximumOffset = 0.2
  /// Focal lengths as multiples of the photo's longer side that no lens exceeds, and the maximum
  /// coordinate of a principal point, which may be outside a cropped photo. Chosen: only numbers
  /// that would overflow later are to be excluded.
  private static let possibleFocalLengths = 1e-3...1e4
  private static let maximumCenter = 100.0
  /// Clockwise quarter turns to the upright photo, by EXIF orientation.
  private static let quarterTurnsOfOrientation = [6: 1, 8: 3]

  /// The camera of the upright photo.
  private(set) var camera: Camera
  /// Clockwise quarter turns from the photo that the camera was estimated for to the upright photo.
  private(set) var quarterTurns = 0
  /// Pixels of the photo per pixel of the camera, after the quarter turns.
  private(set) var scale = SIMD2(1.0, 1.0)
  /// Size in pixels that the camera was estimated for.
  private let original: SIMD2<Double>

  /// Nil if the camera and the photo differ in aspect ratio.
  init?(_ camera: Camera, to photo: Photo, isSizeKnown: Bool) {
    var camera = camera
    if !isSizeKnown {
      guard let size = Self.size(camera.principalPoint, photo) else { return nil }
      (camera.width, camera.height) = size
    }
    self.camera = camera
    original = [Double(camera.width), Double(camera.height)]
    if !Self.agree(camera, photo), let turns = Self.quarterTurnsOfOrientation[photo.orientation] {
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

  /// The size, of the upright or of the stored photo, whose center is closer to the principal
  /// point; nil if both centers are far from it.
  private static func size(
    _ principalPoint: SIMD2<Double>, _ photo: Photo
  ) -> (width: Int, height: Int)? {
    func offset(_ width: Int, _ height: Int) -> Double {
      let center = principalPoint / SIMD2(Double(width), Double(height))
      return max(abs(center.x - 0.5), abs(center.y - 0.5))
    }
    let upright = offset(photo.width, photo.height)
    let stored = photo.orientation > 4 ? offset(photo.height, photo.width) : .infinity
    guard min(upright, stored) < maximumOffset else { return nil }
    return upright <= stored ? (photo.width, photo.height) : (photo.height, photo.width)
  }

  /// Whether the aspect ratios agree to within one pixel of the smaller of the two.
  private static func agree(_ camera: Camera, _ photo: Photo) -> Bool {
    let (w, h) = (Double(camera.width), Double(camera.height))
    let (width, height) = (Double(photo.width), Double(photo.height))
    return abs(w * height - h * width) <= max(w, width, h, height)
  }

  /// Whether a photo may have this focal length and principal point; the numbers come from a file.
  var isPossible: Bool {
    let (focal, center) = (camera.focalLength, camera.principalPoint)
    let side = camera.longerSide
    return min(focal.x, focal.y) >= Self.possibleFocalLengths.lowerBound * side
      && max(focal.x, focal.y) <= Self.possibleFocalLengths.upperBound * side
      && max(abs(center.x), abs(center.y)) <= Self.maximumCenter * side
  }

  /// Whether the photo differs in size from the photo that the camera was estimated for.
  var isScaled: Bool { scale != [1, 1] }

  /// The pose of the upright photo; the world frame stays unchanged.
  func pose(_ cameraFromWorld: RigidTransform) -> RigidTransform {
    guard quarterTurns > 0 else { return cameraFromWorld }
    let turn = Quaternion(angle: Double(quarterTurns) * .pi / 2, axis: [0, 0, 1])
    return RigidTransform(rotation: turn, translation: .zero) * cameraFromWorld
  }

  /// Maps a pixel of the photo that the camera was estimated for to the upright photo.
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
  /// The camera of the photo rotated clockwise by a quarter turn: the new x axis is the old −y
  /// axis, the new y axis is the old x axis.
  func turnedClockwise() -> Camera {
    Camera(
      width: height, height: width, focalLength: [focalLength.y, focalLength.x],
      principalPoint: [Double(height) - principalPoint.y, principalPoint.x],
      distortion: [distortion.x, distortion.y, distortion.w, -distortion.z],
      calibration: calibration)
  }
}
