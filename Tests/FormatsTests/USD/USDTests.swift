import Foundation
import SceneModel
import Testing

@testable import Formats

@Suite struct USDTests {
  @Test func textShowsTheLayer() {
    var prim = USDPrim("Mesh", "shape")
    prim.apiSchemas = ["MaterialBindingAPI"]
    prim.metadata = [USDField("kind", .token("component"))]
    prim.properties = [
      .attribute(
        "float3[]", "extent", .float3Array([[0, 0.5, 1e-7], [1, 2, 3]]),
        metadata: [USDField("interpolation", .token("vertex"))]),
      .attribute("token", "subdivisionScheme", .token("none"), isUniform: true),
      .connection("color3f", "inputs:c", to: "/shape/s.outputs:rgb"),
      .relationship("material:binding", ["/a", "/b"]),
    ]
    prim.children = [USDPrim("Scope", "inner")]
    let layer = USDLayer(
      metadata: [
        USDField(
          "customLayerData",
          .dictionary([
            USDField("creator", .string("a \"quoted\"\nname")), USDField("n", .double(0.1)),
          ]))
      ], defaultPrim: "shape", prims: [prim])
    #expect(
      USDAText.encode(layer) == #"""
        #usda 1.0
        (
            defaultPrim = "shape"
            customLayerData = {
                string "creator" = "a \"quoted\"\nname"
                double "n" = 0.1
            }
        )

        def Mesh "shape" (
            prepend apiSchemas = ["MaterialBindingAPI"]
            kind = "component"
        )
        {
            float3[] extent = [(0, 0.5, 1e-07), (1, 2, 3)] (
                interpolation = "vertex"
            )
            uniform token subdivisionScheme = "none"
            color3f inputs:c.connect = </shape/s.outputs:rgb>
            rel material:binding = [</a>, </b>]

            def Scope "inner"
            {
            }
        }

        """#)
  }

  @Test func modelHasTheDocumentedStructure() throws {
    let layer = USDModelLayer().layer(Sample.model(rings: 4))
    #expect(layer.defaultPrim == "baked_mesh")
    #expect(layer.metadata.contains(USDField("metersPerUnit", .double(1))))
    #expect(layer.metadata.contains(USDField("upAxis", .token("Y"))))
    let root = try #require(layer.prims.first)
    #expect(root.children.map(\.name) == ["Materials", "Geom"])
    let mesh = try #require(root.children[1].children.first)
    #expect(mesh.apiSchemas == ["MaterialBindingAPI"])
    #expect(
      mesh.properties.contains(
        .attribute("float3[]", "extent", .float3Array([[-1, 0, -1], [1, 2, 1]]))))
    let shaders = root.children[0].children[0].children
    #expect(
      shaders.map(\.name) == [
        "surfaceShader", "uvReader_st", "diffuseColor_texture", "normal_texture",
        "occlusion_texture",
      ])
    #expect(
      shaders[3].properties.contains(
        .attribute("token", "inputs:sourceColorSpace", .token("raw"))))
    #expect(
      shaders[2].properties.contains(
        .attribute("asset", "inputs:file", .asset("0/baked_mesh_tex0.png"))))
  }

  @Test func quadsComeFirst() throws {
    var model = Sample.model(rings: 4, atlasCount: 2)
    model.mesh.atlases[0].quadCount = 3
    let layer = USDModelLayer().layer(model)
    func values(_ name: String, of mesh: String) throws -> [Int32] {
      let geometry = try #require(layer.prims[0].children.last)
      let prim = try #require(geometry.children.first { $0.name == mesh })
      let property = try #require(prim.properties.first { $0.name == name })
      guard case .attribute(_, .intArray(let values)?, _) = property.content else { return [] }
      return values
    }
    let count = model.mesh.atlases[0].triangles.count
    #expect(
      try values("faceVertexCounts", of: "g0")
        == Array(repeating: 4, count: 3) + Array(repeating: 3, count: count - 6))
    let (first, second) = (model.parts[0].triangles[0], model.parts[0].triangles[1])
    #expect(second.a == first.a && second.b == first.c)
    let corners = try values("faceVertexIndices", of: "g0")
    #expect(corners.prefix(4) == [first.a, first.b, first.c, second.c].map { Int32($0) }[...])
    #expect(corners.count == 12 + 3 * (count - 6))
    #expect(try values("primvars:st:indices", of: "g0").count == corners.count)
    #expect(Set(try values("faceVertexCounts", of: "g1")) == [3])
  }

  @Test func atlasMeshesPartitionTheModel() {
    let model = Sample.model(rings: 6, atlasCount: 3)
    let parts = model.parts
    #expect(parts.count == 3)
    #expect(parts.map(\.triangles.count).reduce(0, +) == model.mesh.mesh.triangles.count)
    var index = 0
    for part in parts {
      for (triangle, texture) in zip(part.triangles, part.textureTriangles) {
        let whole = model.mesh.mesh.triangles[index]
        #expect(part.positions[Int(triangle.a)] == model.mesh.mesh.positions[Int(whole.a)])
        #expect(part.normals[Int(triangle.b)] == model.mesh.mesh.normals[Int(whole.b)])
        let st = model.mesh.textureTriangles[index]
        #expect(
          part.textureCoordinates[Int(texture.c)] == model.mesh.textureCoordinates[Int(st.c)])
        index += 1
      }
    }
  }

  @Test func crateHasHeaderAndSections() throws {
    let bytes = USDCrate.encode(USDModelLayer().layer(Sample.model(rings: 8)))
    #expect(Array(bytes.prefix(8)) == Array("PXR-USDC".utf8))
    #expect(Array(bytes[8..<16]) == [0, 8, 0, 0, 0, 0, 0, 0])
    var reader = ByteCursor(bytes, from: 16)
    reader = ByteCursor(bytes, from: Int(try reader.unsigned(8)))
    var names: [String] = []
    var end = 0
    for _ in 0..<(try reader.unsigned(8)) {
      let name = try (0..<16).map { _ in UInt8(try reader.unsigned(1)) }.prefix { $0 != 0 }
      names.append(String(decoding: name, as: UTF8.self))
      let (start, size) = (Int(try reader.unsigned(8)), Int(try reader.unsigned(8)))
      #expect(start >= end && start + size <= bytes.count)
      end = start + size
    }
    #expect(names == ["TOKENS", "STRINGS", "FIELDS", "FIELDSETS", "PATHS", "SPECS"])
    #expect(reader.remaining == 0)
  }

  @Test func cratePathsAreATree() {
    var tokens = CrateTable<String>()
    _ = tokens.index("")
    var paths = CratePaths()
    for path in ["/", "/a", "/a.x:y", "/a/b", "/c/d.z", "/c"] { _ = paths.index(path, &tokens) }
    let encoded = paths.encoded()
    #expect(encoded.paths == [0, 1, 2, 3, 4, 5, 6])
    #expect(encoded.jumps == [-1, 3, 0, -2, -1, -1, -2])
    let names = encoded.tokens.map { ($0 < 0 ? "." : "/") + tokens.elements[Int(abs($0))] }
    #expect(names == ["/", "/a", ".x:y", "/b", "/c", "/d", ".z"])
  }
}
