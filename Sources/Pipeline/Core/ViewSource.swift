import SceneModel

/// Provider of views: the image store, or images in memory.
struct ViewSource: Sendable {
  var reconstruction: Reconstruction
  /// The undistorted view of a photo; the second argument is the maximum number of pixels.
  var view: @Sendable (ID<Photo>, Int) throws -> PinholeView

  init(
    reconstruction: Reconstruction, view: @escaping @Sendable (ID<Photo>, Int) throws -> PinholeView
  ) {
    self.reconstruction = reconstruction
    self.view = view
  }

  init(_ reconstruction: Reconstruction, images: ImageStore) {
    self.init(reconstruction: reconstruction) { photo, maximumPixels in
      try images.pinholeView(photo, of: reconstruction, maximumPixels: maximumPixels)
    }
  }

  /// Mean pixel count of the registered photos.
  var pixelsPerPhoto: Float {
    let cameras = reconstruction.registered.map { reconstruction.camera(of: $0) }
    let sum = cameras.reduce(Float(0)) { $0 + Float($1.width) * Float($1.height) }
    return sum / Float(max(1, cameras.count))
  }

  /// Ratio of full-size photo pixels to pixels of the view, by area. The pixels of a blurred photo
  /// are those of a sharp one with the same detail.
  func areaFactor(of view: PinholeView) -> Float {
    let camera = reconstruction.camera(of: view.photo)
    let ratio = camera.focalLength / view.camera.focalLength
    let detail = reconstruction.photos[view.photo.index].detail(at: camera.width * camera.height)
    return Float(ratio.x * ratio.y * detail)
  }
}
