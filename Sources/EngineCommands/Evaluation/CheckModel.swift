import ArgumentParser
import Formats
import Foundation
import ImageFiles
import Pipeline
import SceneModel
import SharedCommands

/// Checks a USDZ package.
struct CheckModel: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "check",
    abstract: "Check a USDZ file as AR Quick Look and OpenUSD do.",
    discussion: """
      Checks the layout of the package (files stored and aligned to 64 bytes, a binary layer \
      first), the stage (y up, meters, default prim), the meshes (triangles, normals, texture \
      coordinates, extent, materials), the shaders with the types of their inputs, and that every \
      texture is there and can be decoded. With --detail, also the limits of a detail level.

      EXAMPLE
        photogrammetry-cli check model.usdz --detail reduced

      Exit codes: 0 the file is clean, 1 there are findings, 2 there is no file that can be read.
      """)

  @Argument(help: "The file to check.", completion: .file(extensions: ["usdz"]))
  var model: String

  @Option(name: .shortAndLong, help: "A detail level whose limits the model should be within.")
  var detail: DetailArgument?

  @Flag(name: .long, help: "Print one JSON object instead of sentences.")
  var json = false

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    var check: USDZCheck
    do {
      check = try USDZCheck(URL(fileURLWithPath: model))
    } catch {
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
    var largestSide = 0
    for texture in check.textures {
      do {
        let image = try ImageCodec.decode(texture.bytes)
        largestSide = max(largestSide, image.width, image.height)
      } catch {
        check.findings.append("\(texture.path) can't be decoded")
      }
    }
    if let detail { check.compare(with: Self.level(detail), largestSide: largestSide) }
    Terminal.shared.result(try json ? Self.json(check, largestSide) : text(check, largestSide))
    if !check.findings.isEmpty { throw ExitCode(CommandFailure.runCode) }
  }

  private func text(_ check: USDZCheck, _ largestSide: Int) -> String {
    let maps = check.maps.joined(separator: ", ")
    let facts =
      "\(check.triangles) triangles; maps: \(maps.isEmpty ? "none" : maps); largest texture "
      + "\(largestSide)"
    let verdict =
      check.findings.isEmpty
      ? "\(model) is clean." : check.findings.map { "finding: \($0)" }.joined(separator: "\n")
    return facts + "\n" + verdict
  }

  private struct Summary: Encodable {
    var triangles: Int
    var maps: [String]
    var largestTextureSide: Int
    var findings: [String]
  }

  private static func json(_ check: USDZCheck, _ largestSide: Int) throws -> String {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys]
    let summary = Summary(
      triangles: check.triangles, maps: check.maps, largestTextureSide: largestSide,
      findings: check.findings)
    return String(decoding: try encoder.encode(summary), as: UTF8.self)
  }

  /// The limits of Object Capture, which those of the engine are one below.
  private static func level(_ detail: DetailArgument) -> USDZCheck.Level {
    let limits = detail.limits
    return USDZCheck.Level(
      name: detail.rawValue, maximumTriangles: limits.maximumTriangles + 1,
      maximumTextureSide: limits.textureSide, maps: Set(limits.maps.map(\.previewSurfaceInput)))
  }
}

extension TextureMap {
  /// The input of UsdPreviewSurface.
  fileprivate var previewSurfaceInput: String {
    self == .ambientOcclusion ? "occlusion" : rawValue
  }
}
