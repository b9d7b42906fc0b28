import Foundation

extension USDZPackage {
  /// The model in the first layer of an archive. Throws a `FormatFault`, an `UnsupportedFeature`,
  /// or `ByteCursor.Truncated`.
  static func decode(_ bytes: [UInt8]) throws -> LoadedModel {
    let archive = try ZipArchive(bytes)
    let layer = archive.entries.first {
      USDLayer.fileExtensions.contains(($0.name as NSString).pathExtension.lowercased())
    }
    guard let layer else { throw FormatFault("it contains no USD layer") }
    let budget = MemoryBudget(forFileOf: bytes.count)
    func contents(_ name: String) throws -> [UInt8]? { try archive.contents(of: name) }
    let stage = try USDStage(layer.name, budget: budget, contents: contents)
    return try USDScene.model(of: stage, budget: budget, contents: contents)
  }
}
