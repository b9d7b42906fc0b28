import ArgumentParser
import Foundation
import RealityKit

/// How fine a model is: one of the levels, or bounds of one's own.
struct DetailArguments: ParsableArguments {
  typealias Specification = PhotogrammetrySession.Configuration.CustomDetailSpecification

  /// The levels and their bounds, as a section of help.
  static let help = """
    DETAIL LEVELS (upper bounds; poor photos give less)
      level     triangles    texture           maps
      preview      25,000    1024 x 1024       colour, normal, occlusion
      reduced      50,000    2048 x 2048       colour, normal, occlusion
      medium      100,000    4096 x 4096       colour, normal, occlusion
      full        250,000    8192 x 8192       and roughness, displacement
      raw      30,000,000    8192 x 8192, 16   colour
      custom   as --max-polygons, --texture-side, --maps and --texture-format
               say; otherwise as medium

    """

  @Option(name: .shortAndLong, help: "How fine the model is; see the table above.")
  var detail = DetailChoice.level(.reduced)

  @Option(name: .long, help: ArgumentHelp("With -d custom: triangles at most.", valueName: "count"))
  var maxPolygons: UInt?

  @Option(name: .long, help: "With -d custom: the texture's side in texels, at most.")
  var textureSide: TextureSideArgument?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "With -d custom, and with commas: color, normal, roughness, displacement, occlusion or all.",
      valueName: "maps"))
  var maps: TextureMapsArgument?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "With -d custom: png, jpeg or jpeg:<quality>, from 0 to 1 (0.8).", valueName: "format"))
  var textureFormat: TextureFormatArgument?

  func validate() throws {
    let options: [(name: String, isGiven: Bool)] = [
      ("--max-polygons", maxPolygons != nil), ("--texture-side", textureSide != nil),
      ("--maps", maps != nil), ("--texture-format", textureFormat != nil),
    ]
    if detail != .custom, let option = options.first(where: \.isGiven) {
      throw ValidationError("\(option.name) is for --detail custom; add -d custom.")
    }
    if maxPolygons == 0 { throw ValidationError("--max-polygons must be 1 or more.") }
  }

  /// The bounds of `custom`.
  var specification: Specification {
    var result = Specification()
    if let maxPolygons { result.maximumPolygonCount = maxPolygons }
    if let textureSide { result.maximumTextureDimension = textureSide.dimension }
    if let maps { result.outputTextureMaps = maps.outputs }
    if let textureFormat { result.textureFormat = textureFormat.format }
    return result
  }
}

/// The detail levels that bound everything.
enum DetailArgument: String, ExpressibleByArgument, CaseIterable {
  case preview, reduced, medium, full, raw

  var detail: PhotogrammetrySession.Request.Detail {
    switch self {
    case .preview: .preview
    case .reduced: .reduced
    case .medium: .medium
    case .full: .full
    case .raw: .raw
    }
  }
}

/// A detail level, or one's own.
enum DetailChoice: ExpressibleByArgument, Equatable {
  case level(DetailArgument)
  case custom

  init?(argument: String) {
    if argument == "custom" {
      self = .custom
    } else if let level = DetailArgument(rawValue: argument) {
      self = .level(level)
    } else {
      return nil
    }
  }

  static let allValueStrings = DetailArgument.allCases.map(\.rawValue) + ["custom"]

  var defaultValueDescription: String {
    switch self {
    case .level(let level): level.rawValue
    case .custom: "custom"
    }
  }

  var detail: PhotogrammetrySession.Request.Detail {
    switch self {
    case .level(let level): level.detail
    case .custom: .custom
    }
  }
}

/// The side of a texture in texels.
enum TextureSideArgument: String, ExpressibleByArgument, CaseIterable {
  case oneK = "1024"
  case twoK = "2048"
  case fourK = "4096"
  case eightK = "8192"
  case sixteenK = "16384"

  var dimension: DetailArguments.Specification.TextureDimension {
    switch self {
    case .oneK: .oneK
    case .twoK: .twoK
    case .fourK: .fourK
    case .eightK: .eightK
    case .sixteenK: .sixteenK
    }
  }
}

/// The textures of a model, by name.
struct TextureMapsArgument: ExpressibleByArgument {
  var outputs: DetailArguments.Specification.TextureMapOutputs = []

  init?(argument: String) {
    for name in argument.split(separator: ",", omittingEmptySubsequences: false) {
      switch name.trimmingCharacters(in: .whitespaces) {
      case "color", "colour": outputs.insert(.diffuseColor)
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

/// How textures are stored.
struct TextureFormatArgument: ExpressibleByArgument {
  var format: DetailArguments.Specification.TextureFormat

  init?(argument: String) {
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
