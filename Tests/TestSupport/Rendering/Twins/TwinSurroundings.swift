import Foundation
import SceneModel

/// What surrounds a `TwinObject`, and the light: a table in a furnished room, or a yard. All values
/// were chosen.
struct TwinSurroundings {
  let surfaces: [RenderedScene.Surface]
  let lighting: RenderedScene.Lighting
  let backdrop: RenderedScene.Backdrop

  init(_ object: TwinObject, seed: UInt64) {
    var random = TwinRandom(seed: seed &* 6_007 &+ object.number)
    if object == .marbleStatue {
      surfaces = Self.yard(&random)
      lighting = Self.daylight(&random)
      backdrop = RenderedScene.Backdrop(low: [0.5, 0.56, 0.62], high: [0.3, 0.46, 0.74])
    } else {
      surfaces = Self.room(&random)
      lighting = CaptureRoom.lighting(seed: random.next())
      backdrop = RenderedScene.Backdrop()
    }
  }

  // MARK: Room

  private static func room(_ random: inout TwinRandom) -> [RenderedScene.Surface] {
    let place = CaptureRoom()
    let paint = CaptureRoom.paint(seed: random.number())
    let table: any SurfaceTexture =
      random.chance(0.5)
      ? ScaledTexture(texture: WoodTexture(seed: random.number()), scale: 0.6)
      : stone(&random)
    return [
      place.tableSurface(table), place.farWall(paint), place.sideWalls(paint),
      place.nearWall(paint),
      place.floorSurface(seed: random.number()),
    ] + (0..<4).map { _ in furniture(in: place, &random) }
  }

  /// Speckled stone or cloth.
  private static func stone(_ random: inout TwinRandom) -> SolidTexture {
    SolidTexture(
      palette: random.tones([0.08, 0.34, 0.5, 0.2, 0.66], saturation: 0.14),
      wavelength: 0.05, octaves: 7, seed: random.number(), contrast: 2.6)
  }

  /// Pictures on the walls and cupboards before them, with a texture of their own.
  private static func furniture(
    in place: CaptureRoom, _ random: inout TwinRandom
  ) -> RenderedScene.Surface {
    var mesh = Mesh()
    for _ in 0..<3 {
      let isPicture = random.chance(0.6)
      let isAcross = random.chance(0.5)
      let side = random.chance(0.5) ? 1.0 : -1.0
      let (wall, along) = isAcross ? (place.walls.x, place.walls.y) : (place.walls.y, place.walls.x)
      let half = SIMD3(
        random.double(0.12, 0.3), isPicture ? random.double(0.1, 0.25) : random.double(0.3, 0.5),
        isPicture ? 0.012 : random.double(0.08, 0.13))
      let height = isPicture ? random.double(0.1, 0.5) : half.y - 0.74
      let middle = SIMD3(random.within(along - 0.35), height, side * (wall - half.z))
      mesh.append(
        .box(center: middle, halfSize: half).placed(turned: isAcross ? .pi / 2 : 0, at: .zero))
    }
    let texture = SolidTexture(
      palette: random.tones([0.06, 0.3, 0.5, 0.16, 0.62], saturation: 0.5),
      wavelength: random.value(0.08, 0.25), octaves: 6, seed: random.number(),
      contrast: random.value(1.5, 5))
    return RenderedScene.Surface(mesh: mesh, texture: texture)
  }

  // MARK: Yard

  private static func yard(_ random: inout TwinRandom) -> [RenderedScene.Surface] {
    let gravel = SolidTexture(
      palette: random.tones([0.06, 0.24, 0.34, 0.18, 0.46], saturation: 0.08),
      wavelength: 0.22, octaves: 7, seed: random.number(), contrast: 2.4)
    let leaves = SolidTexture(
      palette: [
        [0.01, 0.02, 0.008], [0.04, 0.09, 0.02], [0.1, 0.17, 0.04], [0.05, 0.1, 0.03],
        [0.24, 0.3, 0.1],
      ], wavelength: 0.5, octaves: 6, seed: random.number(), contrast: 3)
    let phases = (0..<4).map { _ in random.double(0, 2 * Double.pi) }
    let hedge = RenderedScene.grid(columns: 241, rows: 30, isClosed: false) { u, v in
      let angle = -2 * Double.pi * u
      let top = 2.4 + 0.5 * sin(3 * angle + phases[0]) + 0.25 * sin(11 * angle + phases[1])
      let bulge = 0.5 * sin(7 * angle + phases[2]) + 0.25 * sin(19 * angle + 5 * v + phases[3])
      let radius = 7.5 + bulge * (1 - 0.5 * v)
      return SIMD3(radius * sin(angle), top * v, radius * cos(angle))
    }
    return [
      RenderedScene.Surface(mesh: RenderedScene.tableMesh(halfSide: 12), texture: gravel),
      RenderedScene.Surface(mesh: hedge.deformed(), texture: leaves),
    ] + (0..<2).map { _ in yardFurniture(&random) }
  }

  /// Trunks and boxes of wood or brick around the statue.
  private static func yardFurniture(_ random: inout TwinRandom) -> RenderedScene.Surface {
    var mesh = Mesh()
    for _ in 0..<5 {
      let (azimuth, distance) = (random.double(0, 2 * Double.pi), random.double(4.6, 6.3))
      let place = SIMD3(distance * sin(azimuth), 0, distance * cos(azimuth))
      if random.chance(0.5) {
        mesh.append(
          .rod(
            from: place - SIMD3(0, 0.2, 0),
            to: place + SIMD3(random.within(0.2), 3.4, random.within(0.2)),
            radius: random.double(0.08, 0.18), columns: 24, rows: 40))
      } else {
        let half = SIMD3(
          random.double(0.2, 0.7), random.double(0.15, 0.4), random.double(0.15, 0.25))
        mesh.append(
          Mesh.box(center: [0, half.y, 0], halfSize: half)
            .placed(turned: random.double(0, 3.0), at: place))
      }
    }
    var texture = SolidTexture(
      palette: random.tones([0.05, 0.16, 0.3, 0.1, 0.4], saturation: 0.15).map {
        $0 * [1.2, 0.92, 0.7]
      },
      wavelength: 0.12, octaves: 6, seed: random.number(), contrast: 2.6)
    texture.stretch = [1, random.value(1, 4), 1]
    return RenderedScene.Surface(mesh: mesh, texture: texture)
  }

  /// A low sun and a bright sky.
  private static func daylight(_ random: inout TwinRandom) -> RenderedScene.Lighting {
    var lighting = RenderedScene.Lighting()
    let (azimuth, elevation) = (random.double(0, 2 * Double.pi), random.double(0.65, 1.0))
    lighting.sunDirection = SIMD3<Float>(
      [cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth)])
    (lighting.ambient, lighting.sky, lighting.sun) = (0.42, 0.16, 0.5)
    return lighting
  }
}
