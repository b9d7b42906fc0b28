import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

@Suite struct TextureMappingTests {
  /// A smooth pattern, brighter than 60 everywhere.
  private static func color(_ p: SIMD3<Float>) -> SIMD3<Float> {
    let waves = SIMD3<Float>(sin(5 * p.x), sin(4 * p.y + 1), cos(5 * p.z))
    return 140 + 50 * waves
  }

  private let mesh = SyntheticMesh.sphere(subdivisions: 4)

  private func texture(
    _ scene: SphereScene, mesh: Mesh? = nil, side: Int = 512,
    maps: Set<TextureMap> = [.diffuseColor], threads: Int = 1,
    change: (inout TextureMapping.Options) -> Void = { _ in }
  ) throws -> TexturedMesh {
    var options = TextureMapping.Options(textureSide: side, maps: maps)
    change(&options)
    return try TextureMapping(options: options).run(
      mesh ?? self.mesh, dense: self.mesh, reconstruction: scene.reconstruction,
      images: ImageStore(images: scene.images),
      StageContext(control: KernelControl(threadCount: threads)))
  }

  /// Position and texture color at the centers of the triangles.
  private func samples(
    _ model: TexturedMesh
  ) throws -> [(position: SIMD3<Float>, color: SIMD3<Float>)] {
    let images = try model.atlases.flatMap { atlas in
      let image = try #require(atlas.maps[.diffuseColor])
      return atlas.triangles.map { _ in image }
    }
    return zip(images, zip(model.mesh.triangles, model.textureTriangles)).map { image, triangle in
      let (t, uv) = triangle
      let positions = model.mesh.positions
      let p = positions[Int(t.a)] + positions[Int(t.b)] + positions[Int(t.c)]
      let coordinates = model.textureCoordinates
      let sum = coordinates[Int(uv.a)] + coordinates[Int(uv.b)] + coordinates[Int(uv.c)]
      let st = sum / 3
      let x = min(Int(st.x * Float(image.width)), image.width - 1)
      let y = min(Int((1 - st.y) * Float(image.height)), image.height - 1)
      let start = 3 * (y * image.width + x)
      return (
        p.normalized,
        SIMD3(
          Float(image.pixels[start]), Float(image.pixels[start + 1]),
          Float(image.pixels[start + 2]))
      )
    }
  }

  @Test func textureMatchesTheSphere() throws {
    let model = try texture(SphereScene(viewCount: 12, color: Self.color))
    #expect(model.textureTriangles.count == mesh.triangles.count)
    #expect(model.textureCoordinates.allSatisfy { $0.min() >= 0 && $0.max() <= 1 })
    for sample in try samples(model) {
      let difference = sample.color - Self.color(sample.position)
      #expect(pointwiseMax(difference, -difference).max() < 8)
    }
  }

  @Test func exposureDifferencesAreCompensated() throws {
    let scene = SphereScene(viewCount: 14, gains: [0.85, 1.1], color: Self.color)
    let model = try texture(scene)
    // One gain for the whole model is arbitrary.
    let all = try samples(model)
    let expected = all.map { Self.color($0.position) }
    let ratio = all.map(\.color.x).reduce(0, +) / expected.map(\.x).reduce(0, +)
    let errors = zip(all, expected).map { abs($0.color.y - ratio * $1.y) }
    #expect(errors.reduce(0, +) / Float(errors.count) < 2)
    #expect((errors.max() ?? 0) < 10)
    #expect(ratio > 0.85 && ratio < 1.1)
  }

  /// The photos of the upper half are darker. With the gains of the whole, the halves agree.
  @Test(arguments: [false, true]) func partsOfASurface(knowGains isKnown: Bool) throws {
    let gains = (0..<14).map { $0 < 7 ? Float(0.8) : 1.1 }
    let scene = SphereScene(viewCount: gains.count, gains: gains, color: Self.color)
    let images = ImageStore(images: scene.images)
    let mapping = TextureMapping(options: .init(textureSide: 512, maps: [.diffuseColor]))
    let known =
      isKnown
      ? try mapping.gains(on: mesh, scene.reconstruction, images: images, StageContext()) : nil
    let ratios = try [Float(-1), 1].map { sign in
      var (part, rest) = (mesh, mesh)
      let isInside = mesh.triangles.map { t in sign * mesh.positions[Int(t.a)].y > 0 }
      part.triangles = zip(mesh.triangles, isInside).filter(\.1).map(\.0)
      rest.triangles = zip(mesh.triangles, isInside).filter { !$0.1 }.map(\.0)
      part = part.withoutUnusedVertices()
      let model = try mapping.run(
        part, dense: part, occluders: rest, reconstruction: scene.reconstruction, images: images,
        gains: known, StageContext())
      let atSeam = try samples(model).filter { abs($0.position.y) < 0.2 }
      let expected = atSeam.map { Self.color($0.position).y }
      return atSeam.map(\.color.y).reduce(0, +) / expected.reduce(0, +)
    }
    let difference = abs(log(ratios[1] / ratios[0]))
    #expect(isKnown ? difference < 0.01 : difference > 0.03, "\(ratios)")
  }

  @Test func croppedSurfaceStillOccludes() throws {
    let scene = SphereScene(viewCount: 12, color: Self.color)
    // A cap that occludes the upper part of the sphere in all photos.
    var cap = SyntheticMesh.sphere(radius: 1.2, subdivisions: 4)
    cap.triangles.removeAll { t in t.vertices.contains { cap.positions[$0].y < 0 } }
    let model = try TextureMapping(options: .init(textureSide: 512, maps: [.diffuseColor])).run(
      mesh, dense: mesh, occluders: cap, reconstruction: scene.reconstruction,
      images: ImageStore(images: scene.images), StageContext())
    #expect(model.mesh.triangles.count == mesh.triangles.count)
    let errors = try samples(model).map { sample in
      (y: sample.position.y, error: abs(sample.color.x - Self.color(sample.position).x))
    }
    func mean(_ values: [Float]) -> Float { values.reduce(0, +) / Float(values.count) }
    #expect(mean(errors.filter { $0.y < -0.3 }.map(\.error)) < 3)
    #expect(mean(errors.filter { $0.y > 0.6 }.map(\.error)) > 20)
  }

  @Test func unseenSurfaceIsFilledFromItsSurroundings() throws {
    var scene = SphereScene(viewCount: 12, color: Self.color)
    // Only the upper cameras remain.
    for index in 6..<12 { scene.reconstruction.poses[index] = nil }
    let all = try samples(texture(scene))
    #expect(all.allSatisfy { $0.color.min() > 40 })
    let below = all.filter { $0.position.y < -0.9 }
    // A twentieth of a sphere's surface is below −0.9.
    #expect(abs(Double(below.count) / Double(all.count) - 0.05) < 0.03)
  }

  @Test func occludedPartsOfAPhotoAreNotUsed() throws {
    var scene = SphereScene(viewCount: 30, color: Self.color)
    // A magenta block in the middle of one photo.
    for y in 80..<120 {
      for x in 80..<120 {
        let start = 3 * (y * 200 + x)
        scene.images[5].pixels[start] = 255
        scene.images[5].pixels[start + 1] = 0
        scene.images[5].pixels[start + 2] = 255
      }
    }
    let worst = try samples(texture(scene)).map { sample in
      let difference = sample.color - Self.color(sample.position)
      return pointwiseMax(difference, -difference).max()
    }.max()
    #expect(try #require(worst) < 30)
  }

  @Test func mapsOfASphereAreFlatAndUnoccluded() throws {
    let model = try texture(
      SphereScene(viewCount: 8, color: Self.color), mesh: SyntheticMesh.sphere(subdivisions: 3),
      maps: [.normal, .ambientOcclusion, .roughness, .displacement])
    let maps = model.atlases[0].maps
    #expect(Set(maps.keys) == [.normal, .ambientOcclusion, .roughness, .displacement])
    let normals = try #require(maps[.normal])
    // The smooth normals of both spheres agree.
    for index in stride(from: 0, to: normals.pixels.count, by: 3) {
      #expect(abs(Int(normals.pixels[index]) - 128) < 14)
      #expect(normals.pixels[index + 2] > 240)
    }
    #expect(maps[.ambientOcclusion]?.pixels.allSatisfy { $0 > 240 } == true)
    #expect(maps[.roughness]?.pixels.allSatisfy { $0 == 230 } == true)
  }

  @Test(.endToEnd) func textureDoesNotDependOnThreads() throws {
    let scene = SphereScene(viewCount: 8, color: Self.color)
    let maps: Set<TextureMap> = [.diffuseColor, .normal, .ambientOcclusion]
    let one = try texture(scene, maps: maps, threads: 1)
    let two = try texture(scene, maps: maps, threads: 2)
    #expect(one.textureCoordinates == two.textureCoordinates)
    #expect(one.textureTriangles == two.textureTriangles)
    #expect(one.atlases[0].maps == two.atlases[0].maps)
  }

  @Test func excessDetailGoesIntoSeveralTextures() throws {
    let scene = SphereScene(viewCount: 12, color: Self.color)
    let maps: Set<TextureMap> = [.diffuseColor, .normal, .ambientOcclusion]
    let model = try texture(scene, side: 128, maps: maps) { $0.maximumAtlases = 3 }
    #expect(model.atlases.count == 3)
    var next = 0
    for atlas in model.atlases {
      #expect(atlas.triangles.lowerBound == next && !atlas.triangles.isEmpty)
      next = atlas.triangles.upperBound
      #expect(Set(atlas.maps.keys) == maps)
      #expect(atlas.maps.values.allSatisfy { $0.width == 128 })
    }
    #expect(next == mesh.triangles.count)
    #expect(Set(model.mesh.triangles).count == mesh.triangles.count)
    for sample in try samples(model) {
      let difference = sample.color - Self.color(sample.position)
      #expect(pointwiseMax(difference, -difference).max() < 12)
    }
    // If one is sufficient, there is only one.
    #expect(try texture(scene, side: 2048) { $0.maximumAtlases = 3 }.atlases.count == 1)
  }

  @Test func coarsePhotosGetASmallTexture() throws {
    let model = try texture(
      SphereScene(viewCount: 8, imageSize: 100, color: Self.color), side: 4096)
    #expect(try #require(model.atlases[0].maps[.diffuseColor]).width <= 1024)
  }

  @Test func emptyMeshHasAnErrorMessage() {
    let scene = SphereScene(viewCount: 3, imageSize: 20, color: Self.color)
    #expect(throws: PipelineError.self) { try texture(scene, mesh: Mesh()) }
  }

  @Test func cancellationStops() throws {
    let scene = SphereScene(viewCount: 4, imageSize: 60, color: Self.color)
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try TextureMapping().run(
        mesh, dense: mesh, reconstruction: scene.reconstruction,
        images: ImageStore(images: scene.images),
        StageContext(control: KernelControl(flag: flag)))
    }
  }
}
