import Foundation

/// Layers of USD as files of their own.
enum USDFile {
  /// The model in the layer `bytes` of the file `name`, and in those of `files` that it refers to.
  /// Throws a `FormatFault`, an `UnsupportedFeature`, or `ByteCursor.Truncated`.
  static func decode(
    _ bytes: [UInt8], name: String, files: RelatedFiles
  ) throws -> LoadedModel {
    let budget = MemoryBudget(forFileOf: bytes.count)
    func contents(_ path: String) -> [UInt8]? {
      if path == name { return bytes }
      let bytes = files.contents(of: path)
      budget.extend(byFileOf: bytes?.count ?? 0)
      return bytes
    }
    let stage = try USDStage(name, budget: budget, contents: contents)
    return try USDScene.model(of: stage, budget: budget, contents: contents)
  }
}
