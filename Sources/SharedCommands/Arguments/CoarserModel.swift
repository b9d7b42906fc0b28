import Foundation

/// A model at a lower level than the one that the user named, from the same run.
package struct CoarserModel: Equatable, Sendable {
  package let level: DetailArgument
  package let output: ModelOutput

  /// The models of `--lod` next to `output`, coarse to fine: `model-preview.usdz` next to
  /// `model.usdz`. Throws a `CommandFailure` if one can't be written.
  package static func all(
    _ detail: DetailArguments, nextTo output: ModelOutput
  ) throws -> [CoarserModel] {
    guard detail.lod else { return [] }
    guard output.format != .folder else {
      throw CommandFailure.usage(
        "--lod writes several files, and \(output.url.relativePath) is a folder. Name a file, "
          + "for instance model.usdz, or omit --lod.")
    }
    return try detail.coarserLevels.map {
      CoarserModel(level: $0, output: try output.atLevel($0))
    }
  }
}
