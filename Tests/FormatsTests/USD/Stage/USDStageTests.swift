import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

/// Layers as other programs write them.
@Suite struct USDStageTests {
  /// Z up and centimeters; two materials on the faces of a mesh, one of them a plain color.
  private static let foreign = """
    #usda 1.0
    (
        "A comment"
        defaultPrim = "Root"
        metersPerUnit = 0.01
        upAxis = "Z"
        customLayerData = { string creator = "x"; dictionary inner = { int a = 1 } }
    )

    def Xform "Root" (
        kind = "component"
    )
    {
        double3 xformOp:translate = (100, 0, 0)
        float3 xformOp:rotateXYZ = (0, 0, 90)
        float3 xformOp:scale.timeSamples = { 0: (2, 2, 2), 1: (9, 9, 9), }
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]

        def Mesh "Quad" (
            prepend apiSchemas = ["MaterialBindingAPI"]
        )
        {
            int[] faceVertexCounts = [4, 3]
            int[] faceVertexIndices = [0, 1, 2, 3, 0, 1, 4]
            point3f[] points = [(0, 0, 0), (100, 0, 0), (100, 100, 0), (0, 100, 0), (0, 0, 50)]
            texCoord2f[] primvars:UVMap = [(0, 0), (1, 0), (1, 1), (0, 1)] (
                interpolation = "faceVarying"
            )
            int[] primvars:UVMap:indices = [0, 1, 2, 3, 0, 1, 2]
            color3f[] primvars:displayColor = [(1, 0, 0)]
            rel material:binding = </Root/Looks/Plain>

            def GeomSubset "first" (prepend apiSchemas = ["MaterialBindingAPI"])
            {
                uniform token elementType = "face"
                uniform token familyName = "materialBind"
                int[] indices = [0]
                rel material:binding = <../../Looks/Textured>
            }
        }

        def Mesh "Hidden"
        {
            token visibility = "invisible"
            int[] faceVertexCounts = [3]
            int[] faceVertexIndices = [0, 1, 2]
            point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
        }

        def Scope "Looks"
        {
            def Material "Textured"
            {
                asset inputs:image = @./textures/a b.png@ (colorSpace = "sRGB")
                token outputs:surface.connect = <Surface.outputs:surface>
                def Shader "Surface"
                {
                    uniform token info:id = "UsdPreviewSurface"
                    color3f inputs:diffuseColor = (1, 1, 1)
                    color3f inputs:diffuseColor.connect = </Root/Looks/Textured/Map.outputs:rgb>
                    token outputs:surface
                }
                def Shader "Map"
                {
                    uniform token info:id = "UsdUVTexture"
                    asset inputs:file.connect = </Root/Looks/Textured.inputs:image>
                    float2 inputs:st.connect = </Root/Looks/Textured/Shift.outputs:result>
                    float4 inputs:scale = (0.5, 0.5, 0.5, 1)
                    float3 outputs:rgb
                }
                def Shader "Shift"
                {
                    uniform token info:id = "UsdTransform2d"
                    float2 inputs:in.connect = </Root/Looks/Textured/Reader.outputs:result>
                    float2 inputs:translation = (0.25, 0)
                }
                def Shader "Reader"
                {
                    uniform token info:id = "UsdPrimvarReader_float2"
                    token inputs:varname = "UVMap"
                    float2 outputs:result
                }
            }
            def Material "Plain"
            {
                token outputs:surface.connect = </Root/Looks/Plain/Surface.outputs:surface>
                def Shader "Surface"
                {
                    uniform token info:id = "UsdPreviewSurface"
                    color3f inputs:diffuseColor = (0.25, 0.5, 1)
                }
            }
        }
    }
    """

  private func stage(
    _ file: String, _ files: [String: String]
  ) throws -> (stage: USDStage, model: LoadedModel) {
    let budget = MemoryBudget(forFileOf: 1000)
    func contents(_ name: String) -> [UInt8]? { files[name].map { Array($0.utf8) } }
    let stage = try USDStage(file, budget: budget, contents: contents)
    return (stage, try USDScene.model(of: stage, budget: budget, contents: contents))
  }

  @Test func unitsAxesTransformsAndSubsets() throws {
    let folder = try TemporaryFolder()
    try folder.write(Sample.image(1).bytes, as: "textures/a b.png")
    let model = try ModelFile.read(try folder.write(Self.foreign, as: "model.usda"))
    try #require(model.parts.count == 2)
    let textured = model.parts[0], plain = model.parts[1]
    // Scaled by 2, turned from x to y, moved by a meter; then z up to y up.
    let corners: [SIMD3<Float>] = [[1, 0, 0], [1, 0, -2], [-1, 0, -2], [-1, 0, 0]]
    for (found, expected) in zip(textured.positions, corners) {
      #expect((found - expected).length < 1e-5)
    }
    #expect(textured.triangles == [Triangle(0, 1, 2), Triangle(0, 2, 3)])
    #expect(textured.textureCoordinates == [[0.25, 0], [1.25, 0], [1.25, 1], [0.25, 1]])
    #expect(textured.baseColor == Sample.image(1))
    #expect(textured.baseColorFactor == [0.5, 0.5, 0.5])
    #expect(plain.triangles == [Triangle(0, 1, 2)] && plain.baseColor == nil)
    #expect((plain.positions[2] - [1, 1, 0]).length < 1e-5)
    // The color of the material replaces the vertex colors.
    #expect(plain.baseColorFactor == [0.25, 0.5, 1] && plain.colors.isEmpty)
    #expect(model.missingFiles == [])
  }

  @Test func missingTexturesAreListed() throws {
    let model = try stage("a.usda", ["a.usda": Self.foreign]).model
    #expect(model.parts.count == 2 && model.parts[0].baseColor == nil)
    #expect(model.missingFiles == ["textures/a b.png"])
  }

  private static func triangle(_ more: String = "") -> String {
    """
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
    \(more)
    """
  }

  @Test func referencesAreFollowed() throws {
    let files = [
      "main.usda": """
      #usda 1.0
      ( metersPerUnit = 1 subLayers = [@sub/weak.usda@] )
      def Xform "A" ( references = @sub/part.usda@ )
      {
          float3 xformOp:scale = (2, 2, 2)
          uniform token[] xformOpOrder = ["xformOp:scale"]
      }
      def "B" ( prepend payload = [@./sub/part.usda@</Top/Mesh>, @missing.usda@] ) {}
      over "Proto" { def Mesh "m" { \(Self.triangle()) } }
      def "C" ( prepend references = </Proto> ) {}
      """,
      "sub/part.usda": """
      #usda 1.0
      ( defaultPrim = "Top" )
      def Xform "Top" {
          def Mesh "Mesh" {
              \(Self.triangle("rel material:binding = </Top/M>"))
          }
          def Material "M" {
              token outputs:surface.connect = </Top/M/S.outputs:surface>
              def Shader "S" { color3f inputs:diffuseColor = (0, 0, 1) }
          }
      }
      """,
      "sub/weak.usda": """
      #usda 1.0
      def Mesh "Weak" { \(Self.triangle()) }
      over "A" { float3 xformOp:scale = (9, 9, 9) }
      """,
    ]
    let (stage, model) = try stage("main.usda", files)
    #expect(stage.prims.map(\.name) == ["A", "B", "Proto", "C", "Weak"])
    #expect(stage.missingFiles == ["missing.usda"])
    try #require(model.parts.count == 4)
    #expect(
      model.parts.map { $0.positions[2] } == [[2, 2, 0], [1, 1, 0], [1, 1, 0], [1, 1, 0]])
    // The paths of a referenced prim are those of the prim that includes it.
    #expect(model.parts[0].baseColorFactor == [0, 0, 1])
  }

  @Test func circlesAreRefused() throws {
    for text in [
      #"def "A" ( references = @a.usda@</A> ) {}"#, #"def "A" ( references = </A> ) {}"#,
      #"def "A" { def "B" ( references = </A> ) {} }"#,
    ] {
      #expect(throws: FormatFault.self) {
        _ = try self.stage("a.usda", ["a.usda": "#usda 1.0\n\(text)"])
      }
    }
    #expect(throws: FormatFault.self) {
      _ = try self.stage("a.usda", ["a.usda": "#usda 1.0\n( subLayers = [@a.usda@] )"])
    }
  }

  /// Every prim includes the next one twice.
  @Test func repeatedReferencesAreLimited() throws {
    let prims = (0..<15).map {
      """
      def "P\($0)" {
          def "a" ( references = </P\($0 + 1)> ) {}
          def "b" ( references = </P\($0 + 1)> ) {}
      }
      """
    }
    let wide = (0..<200).map { "def \"p\($0)\" {}" }.joined(separator: "\n")
    let text = "#usda 1.0\n" + prims.joined(separator: "\n") + "def \"P15\" { \(wide) }"
    #expect(throws: FormatFault.self) { _ = try self.stage("a.usda", ["a.usda": text]) }
  }

  @Test func deepNestingIsRefused() throws {
    for (open, close) in [("def \"A\" {", "}"), ("float a = (", ")"), ("int[] a = [", "]")] {
      let deep =
        "#usda 1.0\ndef \"R\" {" + String(repeating: open, count: 50_000)
        + String(repeating: close, count: 50_000) + "}"
      #expect(throws: FormatFault.self) { _ = try self.stage("a.usda", ["a.usda": deep]) }
    }
  }

  @Test func pathsAreResolved() {
    #expect(USDPath.absolute("../b.c", from: "/x/a") == "/x/b.c")
    #expect(USDPath.absolute("b/c", from: "/x") == "/x/b/c")
    #expect(USDPath.absolute(".p", from: "/x") == "/x.p")
    #expect(USDPath.absolute("/y", from: "/x") == "/y")
    #expect(USDPath.moved("/a/b.c", from: "/a", to: "/z") == "/z/b.c")
    #expect(USDPath.moved("/ab", from: "/a", to: "/z") == "/ab")
    #expect(USDPath.file("./0/a.png", from: "") == "0/a.png")
    #expect(USDPath.file("../a.png", from: "x/y") == "x/a.png")
    #expect(USDPath.file("../../a.png", from: "x") == "../a.png")
    #expect(USDPath.file("/a.png", from: "x") == "/a.png")
  }
}
