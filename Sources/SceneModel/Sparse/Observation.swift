/// The keypoint of a point in one photo.
package struct Observation: Hashable, Codable, Sendable {
  package var photo: ID<Photo>
  /// Index into the photo's `FeatureSet`; negative without a feature.
  package var feature: Int32
  /// The keypoint in pixels of the upright photo, origin at the top-left corner.
  package var pixel: SIMD2<Double>

  package init(photo: ID<Photo>, feature: Int32, pixel: SIMD2<Double>) {
    self.photo = photo
    self.feature = feature
    self.pixel = pixel
  }
}
