import Kernels
import SceneModel

/// Photos without lens distortion, for the stages from the dense one on.
extension ImageStore {
  /// The camera of `pinholeView` with the same arguments.
  package func pinholeCamera(
    of id: ID<Photo>, in reconstruction: Reconstruction, maximumPixels: Int
  ) throws -> Camera {
    let size = try size(of: id, maximumPixels: maximumPixels)
    let camera = reconstruction.camera(of: id).resized(width: size.width, height: size.height)
    return camera.distortion == .zero
      ? camera : camera.undistortedPinhole(maximumPixels: maximumPixels)
  }

  /// The photo without lens distortion, of at most `maximumPixels` pixels.
  ///
  /// Every pixel has a source in the photo: the view is the largest rectangle around the principal
  /// point that the undistorted photo fills, so it may show a little less than the photo. Its focal
  /// length is the photo's, scaled; without distortion the view is the whole photo.
  package func pinholeView(
    _ id: ID<Photo>, of reconstruction: Reconstruction, maximumPixels: Int
  ) throws -> PinholeView {
    guard reconstruction.photos.indices.contains(id.index),
      let pose = reconstruction.poses[id.index]
    else { throw KernelError.invalidArgument("photo \(id.index) is not registered") }
    let image = try image(id, maximumPixels: maximumPixels)
    let mask = try mask(id, maximumPixels: maximumPixels)
    let camera = reconstruction.camera(of: id).resized(width: image.width, height: image.height)
    guard camera.distortion != .zero else {
      return PinholeView(
        photo: id, image: image, camera: camera, cameraFromWorld: pose, mask: mask)
    }
    let pinhole = try pinholeCamera(of: id, in: reconstruction, maximumPixels: maximumPixels)
    return PinholeView(
      photo: id, image: try image.undistorted(from: camera, to: pinhole), camera: pinhole,
      cameraFromWorld: pose, mask: try mask?.undistorted(from: camera, to: pinhole))
  }

  /// The mask of `pinholeView` with the same arguments.
  package func pinholeMask(
    _ id: ID<Photo>, of reconstruction: Reconstruction, maximumPixels: Int
  ) throws -> RasterImage? {
    guard let mask = try mask(id, maximumPixels: maximumPixels) else { return nil }
    let camera = reconstruction.camera(of: id).resized(width: mask.width, height: mask.height)
    guard camera.distortion != .zero else { return mask }
    let pinhole = try pinholeCamera(of: id, in: reconstruction, maximumPixels: maximumPixels)
    return try mask.undistorted(from: camera, to: pinhole)
  }
}
