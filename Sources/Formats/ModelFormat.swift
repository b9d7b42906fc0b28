import Foundation
import SceneModel

/// The output formats of a model, selected by the extension of the output's name.
package enum ModelFormat: String, CaseIterable, Sendable {
  /// One file for AR Quick Look and usdview.
  case usdz
  /// One file of glTF 2.0, for browsers, engines and Blender.
  case glb
  /// The mesh with a normal and a color per vertex, without textures.
  case ply
  /// A folder with OBJ, MTL, USDA and the textures.
  case folder

  /// The format for the extension of `url`, ignoring case; a folder for any other extension.
  package init(of url: URL) {
    let suffix = url.pathExtension.lowercased()
    self = Self.files.first { $0.rawValue == suffix } ?? .folder
  }

  /// The single-file formats; their raw values are their extensions.
  package static var files: [ModelFormat] { allCases.filter { $0 != .folder } }

  /// The texture maps that this format uses.
  package var maps: Set<TextureMap> {
    switch self {
    case .usdz, .folder: Set(TextureMap.allCases)
    // Core glTF doesn't support displacement.
    case .glb: Set(TextureMap.allCases).subtracting([.displacement])
    case .ply: [.diffuseColor]
    }
  }
}
