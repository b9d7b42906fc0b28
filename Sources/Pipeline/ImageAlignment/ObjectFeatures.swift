import Kernels
import SceneModel

/// Which features of photos belong to the object, by its masks.
struct ObjectFeatures: Sendable {
  /// The photos with their masks; nil masks where none could be estimated.
  var photos: [Photo]
  /// By photo ID and feature. All features of a photo without a mask may belong to the object.
  var isObject: [[Bool]]

  init(photos: [Photo], isObject: [[Bool]]) { (self.photos, self.isObject) = (photos, isObject) }

  /// The features inside masks of any size, or within `margin` of them, a share of the photo's
  /// longer side.
  init(
    _ features: [FeatureSet], photos: [Photo], masks: [RasterImage?], margin: Double,
    _ control: KernelControl
  ) throws {
    self.photos = photos
    isObject = try control.parallelMap(photos.count) { index in
      guard let mask = masks[index] else {
        return [Bool](repeating: true, count: features[index].count)
      }
      let reach = max(1, margin * Double(max(mask.width, mask.height)))
      let dilated = try mask.dilated(by: Int(reach.rounded()))
      let photo = photos[index]
      let factor =
        SIMD2(Double(mask.width), Double(mask.height))
        / SIMD2(Double(photo.width), Double(photo.height))
      return features[index].positions.map { dilated.isMarked(at: SIMD2<Double>($0) * factor) }
    }
  }

  /// The indices of the object's features, by photo.
  var indices: [[Int]] { isObject.map { flags in flags.indices.filter { flags[$0] } } }

  /// How many of them the median photo has.
  var medianCount: Int { isObject.map { flags in flags.count { $0 } }.upperMedian ?? 0 }
}
