import ArgumentParser
import Foundation
import RealityKit

/// The limits of `--detail custom`.
package typealias CustomDetail =
  PhotogrammetrySession.Configuration.CustomDetailSpecification

/// The side of a texture in texels.
package enum TextureSideArgument: String, ExpressibleByArgument, CaseIterable, Sendable {
  case oneK = "1024"
  case twoK = "2048"
  case fourK = "4096"
  case eightK = "8192"
  case sixteenK = "16384"

  /// The side in a session's configuration.
  var dimension: CustomDetail.TextureDimension {
    switch self {
    case .oneK: .oneK
    case .twoK: .twoK
    case .fourK: .fourK
    case .eightK: .eightK
    case .sixteenK: .sixteenK
    }
  }
}

/// The texture maps of a model, by name.
package struct TextureMapsArgument: ExpressibleByArgument {
  /// The maps of a session's configuration.
  package var outputs: CustomDetail.TextureMapOutputs = []

  /// Parses a comma-separated list of names; nil if one is unknown.
  package init?(argument: String) {
    for name in argument.split(separator: ",", omittingEmptySubsequences: false) {
      switch name.trimmingCharacters(in: .whitespaces) {
      case "color", "colour": outputs.insert(.diffuseColor)  // lint-language: allow
      case "normal": outputs.insert(.normal)
      case "roughness": outputs.insert(.roughness)
      case "displacement": outputs.insert(.displacement)
      case "occlusion": outputs.insert(.ambientOcclusion)
      case "all": outputs.formUnion(.all)
      default: return nil
      }
    }
  }
}

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
