import Foundation
import SceneModel

/// The kinds of output that a model is written as; the name of the output decides.
package enum ModelFormat: String, CaseIterable, Sendable {
  /// One file for AR Quick Look and usdview.
  case usdz
  /// One file of glTF 2.0, for browsers, engines and Blender.
  case glb
  /// The mesh with a normal and a colour a vertex, without textures.
  case ply
  /// A folder with OBJ, MTL, USDA and the textures.
  case folder

  /// The format of a file with the suffix of `url`, in capitals or not; else a folder.
  package init(of url: URL) {
    let suffix = url.pathExtension.lowercased()
    self = Self.files.first { $0.rawValue == suffix } ?? .folder
  }

  /// The formats that are one file; each has its raw value as suffix.
  package static var files: [ModelFormat] { allCases.filter { $0 != .folder } }

  /// The texture maps that a model of this kind is made from.
  package var maps: Set<TextureMap> {
    switch self {
    case .usdz, .folder: Set(TextureMap.allCases)
    // Core glTF knows no displacement.
    case .glb: Set(TextureMap.allCases).subtracting([.displacement])
    case .ply: [.diffuseColor]
    }
  }
}
