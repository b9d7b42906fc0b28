import ArgumentParser

/// The image format of textures.
package struct TextureFormatArgument: ExpressibleByArgument {
  /// The format of a session's configuration.
  package var format: CustomDetail.TextureFormat

  /// Parses `png`, `jpeg` or `jpeg:<quality>` with a quality from 0 to 1 (best).
  package init?(argument: String) {
    let parts = argument.split(separator: ":", omittingEmptySubsequences: false)
    switch (parts.first, parts.count) {
    case ("png", 1): format = .png
    case ("jpeg", 1): format = .jpeg()
    case ("jpeg", 2):
      guard let quality = Float(parts[1]), (0...1).contains(quality) else { return nil }
      format = .jpeg(compressionQuality: quality)
    default: return nil
    }
  }
}
