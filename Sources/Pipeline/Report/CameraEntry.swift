import SceneModel

/// A camera that photos share, before and after alignment.
package struct CameraEntry: Hashable, Codable, Sendable {
  /// The parameters of a camera, in pixels of the upright photo.
  package struct Parameters: Hashable, Codable, Sendable {
    package var focalLength: SIMD2<Double>
    package var principalPoint: SIMD2<Double>
    /// OpenCV's k1, k2, p1, p2.
    package var distortion: SIMD4<Double>
    package var source: Camera.Calibration

    init(_ camera: Camera) {
      (focalLength, principalPoint) = (camera.focalLength, camera.principalPoint)
      (distortion, source) = (camera.distortion, camera.calibration)
    }
  }

  /// Size of the photos in pixels, upright, and their number.
  package var width: Int
  package var height: Int
  package var photos: Int
  /// From metadata or a guess; nil for given cameras.
  package var initial: Parameters?
  package var refined: Parameters

  /// The cameras of the registered photos. `initial` are the cameras by photo ID before alignment.
  static func entries(of reconstruction: Reconstruction, initial: [Camera]) -> [CameraEntry] {
    reconstruction.cameras.enumerated().map { index, camera in
      let photos = reconstruction.registered.filter {
        reconstruction.photos[$0.index].camera.index == index
      }
      let first = photos.first.flatMap { initial.indices.contains($0.index) ? $0.index : nil }
      return CameraEntry(
        width: camera.width, height: camera.height, photos: photos.count,
        initial: first.map { Parameters(initial[$0]) }, refined: Parameters(camera))
    }
  }
}
