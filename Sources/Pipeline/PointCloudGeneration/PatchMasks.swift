import Kernels
import SceneModel

/// Keeps the patches of views inside the masks of their photos.
///
/// Every step that makes patches is followed by this one, so that what a mask leaves out neither passes
/// the filter nor grows back.
struct PatchMasks: Sendable {
  private let views: DenseViews
  private let reconstruction: Reconstruction
  private let images: ImageStore
  private let maximumPixels: Int

  /// `maximumPixels` are those of a view.
  init(
    _ views: DenseViews, _ reconstruction: Reconstruction, _ images: ImageStore,
    maximumPixels: Int
  ) {
    (self.views, self.reconstruction) = (views, reconstruction)
    (self.images, self.maximumPixels) = (images, maximumPixels)
  }

  /// Removes the patches of view `index` that lie outside; `map` may have half the view's resolution,
  /// and nobody else may use it yet.
  func apply(to map: PatchMap, _ index: Int) throws {
    let view = views.views[index]
    guard
      let mask = try images.pinholeMask(
        view.photo, of: reconstruction, maximumPixels: maximumPixels)
    else { return }
    let isReduced = map.view.width < mask.width
    // Pixels on the rim have some of the background's colour; at half the resolution they stay, for
    // the sake of the best of their four.
    try map.removePatches(
      outside: mask.resized(width: map.view.width, height: map.view.height),
      least: isReduced ? 64 : 192)
  }
}
