/// How texture images are stored.
package enum TextureFormat: Hashable, Codable, Sendable {
  case png
  /// `quality` ranges from 0 to 1 (best).
  case jpeg(quality: Float)
}
