import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ModelPreviewTests {
  private let background: [UInt8] = [238, 238, 238]
  private let backFace: [UInt8] = [140, 108, 140]

  /// A mesh whose texture is mapped over x and y, from `low` to `high`.
  private func textured(
    _ mesh: Mesh, _ texture: RasterImage?, low: Float = -1, high: Float = 1
  ) -> TexturedMesh {
    let uvs = mesh.positions.map {
      (SIMD2($0.x, $0.y) - low) / (high - low)
    }
    return TexturedMesh(
      mesh: mesh, textureCoordinates: uvs, textureTriangles: mesh.triangles,
      atlases: [
        TextureAtlas(
          triangles: 0..<mesh.triangles.count, maps: texture.map { [.diffuseColor: $0] } ?? [:])
      ])
  }

  private func options(tileSide: Int, views: Int = 8, samples: Int = 1) -> ModelPreview.Options {
    var options = ModelPreview.Options()
    options.tileSide = tileSide
    options.turntable.viewCount = views
    options.picture.samplesPerSide = samples
    return options
  }

  private func pixel(_ image: RasterImage, _ x: Int, _ y: Int) -> [UInt8] {
    Array(image.pixels[3 * (y * image.width + x)..<3 * (y * image.width + x) + 3])
  }

  private func plain(_ color: SIMD3<UInt8>) -> RasterImage {
    RasterImage(
      width: 8, height: 8, channels: 3,
      pixels: (0..<64).flatMap { _ in [color.x, color.y, color.z] })
  }

  /// Analytic color of a texture.
  private func reference(_ image: RasterImage, _ uv: SIMD2<Double>) -> SIMD3<Double> {
    let place = SIMD2(
      uv.x * Double(image.width) - 0.5, (1 - uv.y) * Double(image.height) - 0.5)
    var sum = SIMD3<Double>.zero
    for y in 0..<image.height {
      let v = max(0, 1 - abs(min(max(place.y, 0), Double(image.height - 1)) - Double(y)))
      guard v > 0 else { continue }
      for x in 0..<image.width {
        let u = max(0, 1 - abs(min(max(place.x, 0), Double(image.width - 1)) - Double(x)))
        guard u > 0 else { continue }
        sum += u * v * SIMD3<Double>(SIMD3<UInt8>(pixel(image, x, y)))
      }
    }
    return sum
  }

  @Test func texturesAreRenderedInPerspective() throws {
    let texture = TexturePattern.image(width: 12, height: 12, seed: 3)
    // A floor that extends far away from the viewer.
    let mesh = SyntheticMesh.grid(
      cells: 1, origin: [-1, -1, 2], u: [2, 0, 0], v: [0, 2, -9])
    let (side, focal) = (160, 144.0)
    let camera = Camera(width: side, height: side, focalLength: [focal, focal])
    let pose = RigidTransform(
      rotation: Quaternion(Matrix3(rows: [1, 0, 0], [0, -1, 0], [0, 0, -1])),
      translation: [0, 0.3, 4.5])
    var options = ModelPicture.Options()
    (options.samplesPerSide, options.shading) = (1, 0)
    let model = textured(mesh, texture)
    let image = ModelPicture(options: options, model: model, textures: [try MipMap(texture)])
      .rendered(by: camera, from: pose)
    let caster = RayCaster(
      mesh.triangles.map {
        (mesh.positions[Int($0.a)], mesh.positions[Int($0.b)], mesh.positions[Int($0.c)])
      })
    var (seen, worst) = (0, 0.0)
    for y in 0..<side {
      for x in 0..<side {
        let ray = camera.unproject([Double(x) + 0.5, Double(y) + 0.5])
        let direction = SIMD3<Float>(pose.rotation.conjugate * SIMD3(ray.x, ray.y, 1))
        let center = SIMD3<Float>(pose.center)
        guard let hit = caster.hit(from: center, along: direction) else {
          // At the boundary, the reference may see surface that rounding of the vertices hides.
          continue
        }
        let point = SIMD3<Double>(center + direction * hit.distance)
        let expected = reference(texture, (SIMD2(point.x, point.y) + 1) / 2)
        let found = SIMD3<Double>(SIMD3<UInt8>(pixel(image, x, y)))
        if found == SIMD3<Double>(SIMD3<UInt8>(background)) { continue }
        seen += 1
        worst = max(worst, (found - expected).length)
      }
    }
    #expect(seen > 3000)
    #expect(worst < 2.5)
  }

  /// A texture much finer than the pixels appears as its mean.
  @Test func fineTexturesAreFiltered() throws {
    let side = 512
    let texture = RasterImage(
      width: side, height: side, channels: 3,
      pixels: (0..<side * side).flatMap { place -> [UInt8] in
        let value: UInt8 = (place % side + place / side) % 2 == 0 ? 255 : 0
        return [value, value, value]
      })
    let mesh = SyntheticMesh.grid(cells: 1, origin: [-1, -1, 0], u: [2, 0, 0], v: [0, 2, 0])
    var options = options(tileSide: 48, views: 1)
    options.picture.shading = 0
    let image = try ModelPreview(options).run(textured(mesh, texture), cameras: [], StageContext())
    let inside = (12..<36).flatMap { y in (12..<36).map { pixel(image, $0, y)[0] } }
    #expect(inside.allSatisfy { (123...132).contains($0) })
  }

  /// Boxes, plates, needles and triangle soups of any position and size.
  @Test func eachPictureContainsTheWholeModel() throws {
    var generator = SeededGenerator(seed: 5)
    let side = 40
    for round in 0..<20 {
      let stretch = SIMD3<Float>(
        pow(10, .random(in: -2...1, using: &generator)),
        pow(10, .random(in: -2...1, using: &generator)),
        pow(10, .random(in: -2...1, using: &generator)))
      let middle = SIMD3<Float>(.random(in: -50...50, using: &generator), 3, -7)
      let points = (0..<9).map { _ in
        middle + stretch
          * SIMD3(
            .random(in: -1...1, using: &generator), .random(in: -1...1, using: &generator),
            .random(in: -1...1, using: &generator))
      }
      let mesh = Mesh(
        positions: points, triangles: [.init(0, 1, 2), .init(3, 4, 5), .init(6, 7, 8)])
      var options = options(tileSide: side)
      options.turntable.elevationDegrees = .random(in: 5...60, using: &generator)
      let view = try Turntable(options: options.turntable)
        .viewpoints(of: points, cameras: [], side: side, KernelControl())
      let size = SIMD2(Double(view.camera.width), Double(view.camera.height))
      let margin = 0.04 * Double(side) - 1e-6
      var (low, high) = (size, SIMD2<Double>.zero)
      for pose in view.poses {
        for point in points {
          let p = pose * SIMD3<Double>(point)
          #expect(p.z > 0)
          let pixel = view.camera.project(p)
          (low, high) = (pointwiseMin(low, pixel), pointwiseMax(high, pixel))
        }
      }
      #expect(low.min() > margin && (size - high).min() > margin, "round \(round)")
      // As large as possible.
      #expect((high - low).max() > 0.9 * Double(side) && size.max() == Double(side))

      let overview = try ModelPreview(options).run(textured(mesh, nil), cameras: [], StageContext())
      let (width, height) = (view.camera.width, view.camera.height)
      #expect(overview.width == 4 * width && overview.height == 2 * height)
      for y in 0..<overview.height {
        for x in 0..<overview.width where x % width == 0 || y % height == 0 {
          #expect(pixel(overview, x, y) == background)
          #expect(pixel(overview, x / width * width + width - 1, y) == background)
        }
      }
    }
  }

  @Test func directionsAreNotMirrored() throws {
    let turntable = Turntable()
    let points = SyntheticMesh.sphere(subdivisions: 1).positions
    let poses = try turntable.viewpoints(
      of: points, cameras: [], side: 99, KernelControl()
    ).poses
    #expect(poses.count == 8)
    // The first viewer is on the side of +z, the next ones proceed toward +x.
    #expect(poses[0].center.z > 3 && abs(poses[0].center.x) < 1e-9 && poses[0].center.y > 0.5)
    #expect(poses[2].center.x > 3 && abs(poses[2].center.z) < 1e-9)
    #expect((poses[0] * SIMD3(1, 0, 0)).x > 0 && (poses[0] * SIMD3(0, 1, 0)).y < 0)
    #expect((poses[2] * SIMD3(0, 0, 1)).x < 0)
  }

  @Test func holesShowBackFaces() throws {
    // The lower half of a ball, seen from above.
    var bowl = SyntheticMesh.sphere(subdivisions: 4)
    bowl.triangles.removeAll { bowl.positions[Int($0.a)].y > 0.01 }
    var options = options(tileSide: 80, views: 2)
    options.turntable.elevationDegrees = 40
    let image = try ModelPreview(options).run(
      textured(bowl, plain([200, 40, 40])), cameras: [], StageContext())
    let colors = (0..<image.width * image.height).map {
      Array(image.pixels[3 * $0..<3 * $0 + 3])
    }
    let inside = colors.count { $0 == backFace }
    let outside = colors.count { Int($0[0]) > 2 * Int($0[1]) }
    #expect(inside > 1000 && outside > 500)
    // Only background remains.
    #expect(inside + outside + colors.count { $0 == background } == colors.count)
  }

  @Test func nearerSurfaceIsVisible() throws {
    // A red plate in front of a larger green one.
    var mesh = SyntheticMesh.grid(cells: 1, origin: [-1, -1, 0], u: [2, 0, 0], v: [0, 2, 0])
    let near = SyntheticMesh.grid(
      cells: 1, origin: [-0.5, -0.5, 0.5], u: [1, 0, 0], v: [0, 1, 0])
    mesh.append(near)
    let uv: [SIMD2<Float>] = [[0.5, 0.5]]
    let model = TexturedMesh(
      mesh: mesh, textureCoordinates: uv,
      textureTriangles: mesh.triangles.map { _ in Triangle(0, 0, 0) },
      atlases: [
        TextureAtlas(triangles: 0..<2, maps: [.diffuseColor: plain([0, 200, 0])]),
        TextureAtlas(triangles: 2..<4, maps: [.diffuseColor: plain([200, 0, 0])]),
      ])
    var options = options(tileSide: 60, views: 1)
    (options.turntable.elevationDegrees, options.picture.shading) = (0, 0)
    let image = try ModelPreview(options).run(model, cameras: [], StageContext())
    #expect(pixel(image, 30, 30) == [200, 0, 0])
    #expect(pixel(image, 8, 30) == [0, 200, 0] && pixel(image, 30, 52) == [0, 200, 0])
  }

  @Test func threadsDoNotChangeThePicture() throws {
    let model = textured(
      SyntheticMesh.sphere(subdivisions: 4), TexturePattern.image(width: 200, height: 200, seed: 9))
    let images = try [1, 4].map { threads in
      try ModelPreview(options(tileSide: 64, samples: 3)).run(
        model, cameras: [], StageContext(control: KernelControl(threadCount: threads)))
    }
    #expect(images[0] == images[1])
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try ModelPreview().run(
        model, cameras: [], StageContext(control: KernelControl(flag: flag)))
    }
  }

  @Test func overviewIsWrittenAsPNG() throws {
    let folder = try TemporaryFolder()
    let file = folder.url.appendingPathComponent("overview.png")
    let model = textured(SyntheticMesh.sphere(subdivisions: 1), nil)
    try ModelPreview(options(tileSide: 16)).write(model, cameras: [], to: file, StageContext())
    let image = try ImageCodec.decode([UInt8](try Data(contentsOf: file)))
    #expect(max(image.width / 4, image.height / 2) == 16)
    _ = folder
  }
}

@Suite struct TurntableTests {
  private func cameras(azimuths: [Double], elevation: Double) -> [RigidTransform] {
    azimuths.map { degrees in
      let (a, e) = (degrees * .pi / 180, elevation * .pi / 180)
      return RigidTransform.lookingAt(
        .zero, from: 4 * SIMD3(cos(e) * sin(a), sin(e), cos(e) * cos(a)))
    }
  }

  private func degrees(_ directions: [Turntable.Direction]) -> [Double] {
    directions.map { $0.azimuth * 180 / .pi }
  }

  @Test func surroundingPhotosGiveAFullTurn() {
    let directions = Turntable().directions(
      cameras(azimuths: Array(stride(from: 3, to: 360, by: 17)), elevation: 33))
    #expect(degrees(directions).map { $0.rounded() } == [0, 45, 90, 135, 180, 225, 270, 315])
    #expect(directions.allSatisfy { abs($0.elevation * 180 / .pi - 33) < 1e-6 })
    // Up to a quarter may be missing.
    let most = Turntable().directions(
      cameras(azimuths: Array(stride(from: 0, to: 270, by: 10)), elevation: 20))
    #expect(degrees(most).last?.rounded() == 315)
  }

  @Test func oneSidedPhotosShowThatSide() {
    // One photo of the back among many of the front.
    let directions = Turntable().directions(
      cameras(azimuths: Array(stride(from: 140, through: 260, by: 5)) + [10], elevation: -5))
    let azimuths = degrees(directions).map { ($0 + 360).truncatingRemainder(dividingBy: 360) }
    #expect(azimuths.allSatisfy { (139...261).contains($0) })
    let reach = (azimuths.max() ?? 0) - (azimuths.min() ?? 0)
    #expect((80...125).contains(reach) && directions.count == 8)
    #expect(directions.allSatisfy { abs($0.elevation * 180 / .pi - 10) < 1e-6 })
    // All from one position.
    let narrow = degrees(Turntable().directions(cameras(azimuths: [90, 91, 89], elevation: 15)))
    #expect(abs((narrow.min() ?? 0) - 50) < 1 && abs((narrow.max() ?? 0) - 130) < 1)
  }

  @Test func overheadPhotosGiveAFullTurn() {
    let down = [-1.0, 0, 1].map { x in
      RigidTransform(
        rotation: Quaternion(Matrix3(rows: [1, 0, 0], [0, 0, 1], [0, -1, 0])),
        translation: [x, 0, 5])
    }
    let directions = Turntable().directions(down)
    #expect(degrees(directions).last?.rounded() == 315)
    #expect(directions.allSatisfy { abs($0.elevation * 180 / .pi - 50) < 1e-6 })
    #expect(Turntable().directions([]).count == 8)
  }
}
