import Foundation
import RealityKit

/// Uses an entity with its mesh, materials and transform.
func useEntity(_ entity: ModelEntity) throws {
  guard let model: ModelComponent = entity.model else { return check(false, "no model") }
  let mesh: MeshResource = model.mesh
  check(mesh.expectedMaterialCount == model.materials.count, "a material for each part")
  check(model.boundsMargin == 0 && entity.isEnabled && !entity.name.isEmpty, "defaults")
  check(entity.visualBounds(relativeTo: nil) == mesh.bounds, "bounds")
  let contents: MeshResource.Contents = mesh.contents
  let models: MeshModelCollection = contents.models
  let instances: MeshInstanceCollection = contents.instances
  for instance: MeshResource.Instance in instances {
    check(models[instance.model]?.id == instance.id, "instances of models")
    check(instance.transform == matrix_identity_float4x4, "at the origin")
  }
  for shape: MeshResource.Model in models {
    let parts: MeshPartCollection = shape.parts
    check(MeshElements<MeshResource.Part>([]).startIndex == parts.startIndex, "collections")
    for part: MeshResource.Part in parts { try use(part, in: mesh) }
  }
  for material: any Material in model.materials { try use(material) }
  try place(entity, mesh)
}

private func use(_ part: MeshResource.Part, in mesh: MeshResource) throws {
  let positions: MeshBuffer<SIMD3<Float>> = part.positions
  check(positions.allSatisfy { mesh.bounds.contains($0) }, "positions are inside the bounds")
  check(part.normals?.count == positions.count, "a normal per vertex")
  check(part.textureCoordinates?.elements.allSatisfy { $0.x >= 0 && $0.y <= 1 } == true, "uv")
  let indices = part.triangleIndices?.elements ?? []
  check(indices.count > 300 && indices.allSatisfy { $0 < positions.count }, "indices")
  check(part.materialIndex == 0 && part.id == "g0", "one part")
  check(positions[positions.startIndex] == positions.elements[0], "elements")
  check(MeshBuffer([1, 2]).endIndex == 2, "end")
}

private func use(_ material: any Material) throws {
  guard var material = material as? PhysicallyBasedMaterial else { return check(false, "material") }
  guard let texture = material.baseColor.texture?.resource else { return check(false, "texture") }
  check(texture.texels.count == texture.width * texture.height * texture.channelCount, "texels")
  check(texture.mipmapLevelCount == 1, "one image")
  check(texture.semantic == TextureResource.Semantic.color, "semantics")
  check(material.normal.texture?.resource.semantic == .normal, "relief")
  check(material.ambientOcclusion.texture?.resource.semantic == .raw, "occlusion")
  check(try texture.pngRepresentation().count > 1000, "PNG")
  let same: MaterialParameters.Texture = PhysicallyBasedMaterial.Texture(texture)
  check(material.baseColor == PhysicallyBasedMaterial.BaseColor(texture: same), "color")
  material.normal = PhysicallyBasedMaterial.Normal(texture: nil)
  material.roughness = PhysicallyBasedMaterial.Roughness(scale: 1)
  material.metallic = PhysicallyBasedMaterial.Metallic(scale: 0)
  material.ambientOcclusion = PhysicallyBasedMaterial.AmbientOcclusion()
  check(material.roughness.scale > material.metallic.scale, "rough and not metallic")
  check(material.roughness.texture == nil && material.metallic.texture == nil, "no textures")
}

private func place(_ entity: ModelEntity, _ mesh: MeshResource) throws {
  let other = ModelEntity(mesh: mesh, materials: [PhysicallyBasedMaterial()])
  other.position = [1, 0, 0]
  other.scale = .one
  other.orientation = simd_quatf(ix: 0, iy: 0, iz: 0, r: 1)
  other.transform.translation.y = 2
  check(other.transformMatrix(relativeTo: entity).columns.3.y == 2, "relative")
  check(other != entity && other.id != entity.id && ModelEntity().model == nil, "identity")
  let component: any Component = other.transform
  check(component is Transform, "a transform is a component")
  other.model = ModelComponent(mesh: mesh, materials: [])
  check(other.model?.materials.isEmpty == true, "changed")
}
