/// What a run's report says about its model, as far as it can be compared between runs.
package struct RunQuality: Codable, Equatable, Sendable {
  /// `good`, `fair`, `poor`, `failed` or `unknown`.
  package var verdict: String?
  /// Mean reprojection error in pixels.
  package var reprojection: Double?
  /// Share of the surface that photos from other places could show, 0…1.
  package var missingShare: Double?
  /// Share of the object's outline in the photos that the model fills, 0…1.
  package var outlineShare: Double?

  package init() {}
}
