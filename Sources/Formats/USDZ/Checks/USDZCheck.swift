import Foundation

/// The findings of a check of a USDZ package, as AR Quick Look and OpenUSD's checker see it.
///
/// The rules are those of the USDZ specification (openusd.org/release/spec_usdz.html) and of
/// `UsdUtils.ComplianceChecker` with ARKit's rules, except that images aren't decoded here.
package struct USDZCheck: Sendable {
  /// What a detail level allows and promises.
  package struct Level: Sendable {
    package var name: String
    package var maximumTriangles: Int
    package var maximumTextureSide: Int
    /// Inputs of UsdPreviewSurface that have a texture.
    package var maps: Set<String>

    package init(
      name: String, maximumTriangles: Int, maximumTextureSide: Int, maps: Set<String>
    ) {
      (self.name, self.maximumTriangles) = (name, maximumTriangles)
      (self.maximumTextureSide, self.maps) = (maximumTextureSide, maps)
    }
  }

  package private(set) var triangles = 0
  /// The inputs of materials with a texture, and the textures by their path.
  package private(set) var maps: [String] = []
  package private(set) var textures: [(path: String, bytes: [UInt8])] = []
  /// Sentences; none for a clean package.
  package var findings: [String] = []

  /// Checks the content of a file. Throws a `FormatError` if it is no package with a layer.
  package init(_ url: URL) throws {
    let bytes = try contents(of: url)
    self = try FormatError.naming(url) { try USDZCheck(bytes) }
  }

  init(_ bytes: [UInt8]) throws {
    let archive = try ZipArchive(bytes)
    findings = try PackageRules(archive).findings
    guard let layer = archive.entries.first, layer.method == 0,
      USDLayer.fileExtensions.contains((layer.name as NSString).pathExtension.lowercased())
    else { throw FormatFault("its first file is no USD layer") }
    let budget = MemoryBudget(forFileOf: bytes.count)
    let root = try USDLayer(try archive.contents(of: layer.name) ?? [], budget: budget)
    let stage = try USDStage(layer.name, budget: budget) { try archive.contents(of: $0) }
    let prims = try PrimTable(stage, budget: budget)
    findings += StageRules(root, missing: stage.missingFiles).findings
    findings += ShaderRules(prims).findings
    let meshes = MeshRules(prims)
    findings += meshes.findings
    (triangles, maps) = (meshes.triangles, meshes.maps.sorted())
    for path in meshes.textures.sorted() {
      if let bytes = try archive.contents(of: path) {
        textures.append((path, bytes))
      } else {
        findings.append("the texture \(path) is not in the package")
      }
    }
    if triangles == 0 { findings.append("there are no triangles") }
  }

  /// Adds what a detail level does not allow. `largestSide` is that of the textures.
  package mutating func compare(with level: Level, largestSide: Int) {
    if triangles > level.maximumTriangles {
      findings.append(
        "\(triangles) triangles, \(level.name) allows \(level.maximumTriangles)")
    }
    if largestSide > level.maximumTextureSide {
      findings.append(
        "a texture's side is \(largestSide), \(level.name) allows \(level.maximumTextureSide)")
    }
    let missing = level.maps.subtracting(maps).sorted()
    if !missing.isEmpty {
      findings.append("maps missing for \(level.name): \(missing.joined(separator: ", "))")
    }
  }
}
