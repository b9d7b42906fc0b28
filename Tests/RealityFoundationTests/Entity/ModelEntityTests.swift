import Foundation
import RealityKit
import SceneModel
import Testing

@testable import RealityFoundation

@Suite struct ModelEntityTests {
  /// Two unit squares at x = 0…1 and 2…3, each with a separate texture; a texture seam separates
  /// the triangles of the first.
  private let textured: TexturedMesh = {
    var mesh = Mesh()
    for x in [Float(0), 2] {
      mesh.positions += [[x, 0, 0], [x + 1, 0, 0], [x + 1, 1, 0], [x, 1, 0]]
    }
    mesh.normals = mesh.positions.map { _ in [0, 0, 1] }
    mesh.triangles = [
      Triangle(0, 1, 2), Triangle(0, 2, 3), Triangle(4, 5, 6), Triangle(4, 6, 7),
    ]
    let texture = [Triangle(0, 1, 2), Triangle(3, 4, 5), Triangle(0, 1, 2), Triangle(0, 2, 3)]
    let coordinates = (0..<6).map { SIMD2<Float>(Float($0) / 8, 0.5) }
    func atlas(_ triangles: Range<Int>, _ gray: UInt8) -> TextureAtlas {
      let color = RasterImage(width: 2, height: 2, channels: 3, filledWith: gray)
      let occlusion = RasterImage(width: 1, height: 1, channels: 1, filledWith: gray)
      return TextureAtlas(
        triangles: triangles, maps: [.diffuseColor: color, .ambientOcclusion: occlusion])
    }
    return TexturedMesh(
      mesh: mesh, textureCoordinates: coordinates, textureTriangles: texture,
      atlases: [atlas(0..<2, 10), atlas(2..<4, 20)])
  }()

  @Test func partsHaveTheirTrianglesAndMaterials() throws {
    let model = try #require(ModelEntity(textured).model)
    #expect(model.mesh.bounds == BoundingBox(min: .zero, max: [3, 1, 0]))
    #expect(model.materials.count == 2 && model.mesh.expectedMaterialCount == 2)
    let shape = try #require(model.mesh.contents.models.first)
    let instance = try #require(model.mesh.contents.instances.first)
    #expect(instance.model == shape.id && instance.transform == matrix_identity_float4x4)
    #expect(shape.parts.map(\.materialIndex) == [0, 1] && shape.parts["g1"]?.materialIndex == 1)
    let first = try #require(shape.parts.first)
    // Two corners are duplicated along the texture seam.
    #expect(first.positions.count == 6 && first.triangleIndices?.elements == [0, 1, 2, 3, 4, 5])
    #expect(first.textureCoordinates?.elements == textured.textureCoordinates)
    #expect(first.normals?.allSatisfy { $0 == [0, 0, 1] } == true)
    #expect(shape.parts["g1"]?.triangleIndices?.elements == [0, 1, 2, 0, 2, 3])
  }

  @Test func texturesCanBeRead() throws {
    let material = try #require(
      ModelEntity(textured).model?.materials.last as? PhysicallyBasedMaterial)
    let color = try #require(material.baseColor.texture?.resource)
    #expect((color.width, color.height, color.channelCount) == (2, 2, 3))
    #expect(color.semantic == .color && color.texels == Array(repeating: 20, count: 12))
    #expect(try color.pngRepresentation().starts(with: [0x89, 0x50, 0x4E, 0x47]))
    #expect(material.ambientOcclusion.texture?.resource.channelCount == 1)
    #expect(material.normal.texture == nil && material.roughness.scale == 0.9)
  }

  @Test func boundsFollowTheTransform() throws {
    let entity = ModelEntity(textured)
    entity.position = [1, 0, 0]
    entity.scale = [2, 2, 2]
    #expect(
      entity.visualBounds(relativeTo: nil) == BoundingBox(min: [1, 0, 0], max: [7, 2, 0]))
    #expect(entity.visualBounds(relativeTo: entity) == entity.model?.mesh.bounds)
    entity.orientation = simd_quatf(angle: .pi / 2, axis: [0, 1, 0])
    let turned = entity.visualBounds(recursive: true, relativeTo: nil, excludeInactive: false)
    #expect(length(turned.min - [1, 0, -6]) < 1e-5 && length(turned.max - [1, 2, 0]) < 1e-5)
    let other = ModelEntity()
    other.transform = entity.transform
    let bounds = entity.visualBounds(relativeTo: other)
    #expect(length(bounds.max - [3, 1, 0]) < 1e-5)
    #expect(other.visualBounds(relativeTo: nil).isEmpty)
    entity.isEnabled = false
    #expect(entity.visualBounds(relativeTo: nil, excludeInactive: true).isEmpty)
  }

  @Test func entitiesHaveIdentity() throws {
    let (a, b) = (ModelEntity(textured), ModelEntity(textured))
    #expect(a != b && a.id != b.id && Set([a, b, a]).count == 2)
    #expect(a.name == b.name && !a.name.isEmpty)
    a.model?.materials.removeLast()
    #expect(a.model?.materials.count == 1 && b.model?.materials.count == 2)
    let mesh = try #require(a.model?.mesh)
    #expect(ModelEntity(mesh: mesh).model?.mesh == mesh && mesh != b.model?.mesh)
  }
}
