import Foundation
import SceneModel
import Testing

@testable import Formats

@Suite struct USDZCheckTests {
  private static let level = USDZCheck.Level(
    name: "reduced", maximumTriangles: 50, maximumTextureSide: 64,
    maps: ["diffuseColor", "normal", "roughness"])

  @Test(arguments: [1, 2]) func writtenPackagesAreClean(_ atlasCount: Int) throws {
    let model = Sample.model(rings: 6, atlasCount: atlasCount)
    let check = try USDZCheck(try USDZPackage.encode(model))
    #expect(check.findings == [])
    #expect(check.triangles == 144)
    #expect(check.maps == ["diffuseColor", "normal", "occlusion"])
    #expect(check.textures.count == 3 * atlasCount)
  }

  @Test func limitsOfALevelAreCompared() throws {
    var check = try USDZCheck(try USDZPackage.encode(Sample.model(rings: 6)))
    check.compare(with: Self.level, largestSide: 128)
    #expect(
      check.findings == [
        "144 triangles, reduced allows 50", "a texture's side is 128, reduced allows 64",
        "maps missing for reduced: roughness",
      ])
  }

  /// A package with a changed layer, and only some of its textures.
  private static func package(
    textures: Bool = true, _ change: (inout USDLayer) -> Void
  ) -> [UInt8] {
    let model = Sample.model(rings: 3)
    let description = USDModelLayer()
    var layer = description.layer(model)
    change(&layer)
    var archive = StoredZip()
    archive.append("model.usdc", USDCrate.encode(layer))
    if textures {
      for texture in model.textures(ofPart: 0) {
        archive.append(
          description.textureFolder + texture.fileName(atlas: 0), texture.image.bytes)
      }
    }
    return archive.finish()
  }

  private static func change(
    _ prims: inout [USDPrim], _ type: String, _ body: (inout USDPrim) -> Void
  ) {
    for index in prims.indices {
      if prims[index].typeName == type { body(&prims[index]) }
      change(&prims[index].children, type, body)
    }
  }

  private typealias Fault = (sentence: String, change: (inout USDLayer) -> Void)

  private static var meshFaults: [Fault] {
    [
      ("the up axis is not Y", { $0.metadata.removeAll { $0.name == "upAxis" } }),
      ("metersPerUnit is not 1", { $0.metadata.removeAll { $0.name == "metersPerUnit" } }),
      ("default prim", { $0.defaultPrim = "" }),
      ("does not exist", { $0.defaultPrim = "other" }),
      ("no normals", { Self.change(&$0.prims, "Mesh") { $0.remove("normals") } }),
      ("no texture coordinates", { Self.change(&$0.prims, "Mesh") { $0.remove("primvars:st") } }),
      ("no extent", { Self.change(&$0.prims, "Mesh") { $0.remove("extent") } }),
      (
        "outside of its extent",
        {
          Self.change(&$0.prims, "Mesh") {
            $0.set("extent", .float3Array([[0, 0, 0], [1, 1, 1]]))
          }
        }
      ),
      (
        "subdivision", { Self.change(&$0.prims, "Mesh") { $0.remove("subdivisionScheme") } }
      ),
      ("no material", { Self.change(&$0.prims, "Mesh") { $0.remove("material:binding") } }),
      ("MaterialBindingAPI", { Self.change(&$0.prims, "Mesh") { $0.apiSchemas = [] } }),
      (
        "points that do not exist",
        {
          Self.change(&$0.prims, "Mesh") { mesh in
            if case .intArray(var indices)? = mesh.value("faceVertexIndices") {
              indices[4] = 100_000
              mesh.set("faceVertexIndices", .intArray(indices))
            }
          }
        }
      ),
    ]
  }

  private static var materialFaults: [Fault] {
    [
      ("ARKit does not display", { Self.change(&$0.prims, "Material") { $0.typeName = "Volume" } }),
      (
        "ARKit does not know",
        {
          Self.change(&$0.prims, "Shader") {
            if $0.value("info:id")?.text == "UsdUVTexture" { $0.set("info:id", .token("Glow")) }
          }
        }
      ),
      (
        "scale and bias",
        { Self.change(&$0.prims, "Shader") { $0.remove("inputs:scale") } }
      ),
      (
        "is no input of",
        {
          Self.change(&$0.prims, "Shader") {
            $0.properties.append(.attribute("float", "inputs:glow", .float(1)))
          }
        }
      ),
      (
        "is double, not float",
        {
          Self.change(&$0.prims, "Shader") {
            if $0.value("info:id")?.text == "UsdPreviewSurface" {
              $0.remove("inputs:roughness")
              $0.properties.append(.attribute("double", "inputs:roughness", .double(1)))
            }
          }
        }
      ),
    ]
  }

  @Test func eachFaultOfALayerIsFound() throws {
    for (sentence, fault) in Self.meshFaults + Self.materialFaults {
      let findings = try USDZCheck(Self.package(fault)).findings
      #expect(findings.contains { $0.contains(sentence) }, "\(sentence): \(findings)")
    }
    #expect(try USDZCheck(Self.package { _ in }).findings == [])
  }

  @Test func faultsOfThePackageAreFound() throws {
    let missing = try USDZCheck(Self.package(textures: false) { _ in }).findings
    #expect(missing.count { $0.contains("is not in the package") } == 3)
    // A byte before the first file moves all others off their alignment.
    var archive = StoredZip()
    archive.append(
      "model.usda", Array(USDAText.encode(USDModelLayer().layer(Sample.model(rings: 3))).utf8))
    archive.append("readme.txt", [1])
    let findings = try USDZCheck(archive.finish()).findings
    #expect(findings.contains { $0.contains("the first file is model.usda") })
    #expect(findings.contains { $0.contains("readme.txt is of a kind") })
    #expect(throws: FormatError.self) {
      try USDZCheck(URL(fileURLWithPath: "/does/not/exist.usdz"))
    }
  }
}

extension USDPrim {
  fileprivate mutating func remove(_ name: String) { properties.removeAll { $0.name == name } }

  /// Replaces the value of an attribute.
  fileprivate mutating func set(_ name: String, _ value: USDValue) {
    for index in properties.indices where properties[index].name == name {
      guard case .attribute(let type, _, _) = properties[index].content else { continue }
      properties[index].content = .attribute(typeName: type, value: value, connections: [])
    }
  }
}
