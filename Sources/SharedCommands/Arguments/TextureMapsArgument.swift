import ArgumentParser
import Foundation

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
