import Kernels
import SceneModel

/// Restricts the patches of views to the masks of their photos.
///
/// Applied after every step that creates patches, so that masked-out areas neither pass the filter
/// nor grow back.
struct PatchMasks: Sendable {
  private let views: DenseViews
  private let reconstruction: Reconstruction
  private let images: ImageStore
  private let maximumPixels: Int

  /// `maximumPixels` is the pixel limit of a view.
  init(
    _ views: DenseViews, _ reconstruction: Reconstruction, _ images: ImageStore,
    maximumPixels: Int
  ) {
    (self.views, self.reconstruction) = (views, reconstruction)
    (self.images, self.maximumPixels) = (images, maximumPixels)
  }

  /// Removes the patches of view `index` outside its mask; `map` may have half the view's
  /// resolution.
  func apply(to map: inout PatchMapBuilder, _ index: Int) throws {
    let view = views.views[index]
    guard
      let mask = try images.pinholeMask(
        view.photo, of: reconstruction, maximumPixels: maximumPixels)
    else { return }
    let isReduced = map.view.width < view.camera.width
    // Boundary pixels mix in background color. At half resolution they stay: one of their four
    // pixels may be fully inside.
    try map.removePatches(
      outside: mask.resized(width: map.view.width, height: map.view.height),
      least: isReduced ? 64 : 192)
  }

  /// Whether there are masks.
  var areUsed: Bool { images.hasMasks }

  /// The silhouettes of the object in all photos with masks; nil without any.
  func silhouettes() throws -> Silhouettes? { try Silhouettes(reconstruction, images: images) }
}
