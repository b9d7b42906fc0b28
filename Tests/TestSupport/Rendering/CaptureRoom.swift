import Foundation
import SceneModel

/// A room with a rectangular table, the upper side of which is at y = 0.
struct CaptureRoom {
  /// Half the size of the table along x and z, in meters.
  var table: SIMD2<Double> = [0.9, 0.55]
  /// The walls are at these distances from the middle of the table.
  var walls: SIMD2<Double> = [1.8, 1.4]
  /// Height of the walls above the table: low enough for the sun to shine on the table.
  var height = 0.9
  private let floor = -0.74

  func tableSurface(_ texture: any SurfaceTexture) -> RenderedScene.Surface {
    let thickness = 0.03
    return RenderedScene.Surface(
      mesh: .box(
        center: [0, -thickness / 2, 0], halfSize: [table.x, thickness / 2, table.y]),
      texture: texture)
  }

  /// The wall on the far side of the table, at −z.
  func farWall(_ texture: any SurfaceTexture) -> RenderedScene.Surface {
    RenderedScene.Surface(mesh: wall(turned: 0), texture: texture)
  }

  /// The walls at both ends of the table.
  func sideWalls(_ texture: any SurfaceTexture) -> RenderedScene.Surface {
    var mesh = wall(turned: -.pi / 2)
    mesh.append(wall(turned: .pi / 2))
    return RenderedScene.Surface(mesh: mesh, texture: texture)
  }

  /// The wall on the near side of the table, at +z.
  func nearWall(_ texture: any SurfaceTexture) -> RenderedScene.Surface {
    RenderedScene.Surface(mesh: wall(turned: .pi), texture: texture)
  }

  func floorSurface(seed: UInt32) -> RenderedScene.Surface {
    RenderedScene.Surface(
      mesh: RenderedScene.tableMesh(halfSide: Float(max(walls.x, walls.y)))
        .placed(at: [0, floor, 0]),
      texture: SolidTexture(
        palette: [[0.16, 0.15, 0.14], [0.24, 0.23, 0.21]], wavelength: 0.1, octaves: 5,
        seed: seed))
  }

  /// Light paint, only slightly uneven.
  static func paint(seed: UInt32) -> SolidTexture {
    var random = SeededGenerator(seed: UInt64(seed))
    let color = SIMD3<Float>([0.72, 0.7, 0.65] + 0.06 * random.uniform())
    return SolidTexture(
      palette: [color * 0.94, color, color * 1.05], wavelength: 0.4, octaves: 5, seed: seed
    ).withContrast(0.2)
  }

  /// The light of a room with the sun from a direction that depends on `seed`, 45° to 65° high.
  static func lighting(seed: UInt64) -> RenderedScene.Lighting {
    var random = SeededGenerator(seed: seed &* 409 &+ 3)
    var lighting = RenderedScene.Lighting.room
    let azimuth = 2 * .pi * random.uniform()
    let elevation = (45 + 20 * random.uniform()) * .pi / 180
    lighting.sunDirection = SIMD3<Float>(
      [cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth)])
    lighting.sun = Float(0.25 + 0.15 * random.uniform())
    lighting.ambient = 0.85 - lighting.sun
    return lighting
  }

  /// A wall that faces +z, turned about the y axis together with the room's other distances.
  private func wall(turned angle: Double) -> Mesh {
    let isAcross = abs(sin(angle)) > 0.5
    let (distance, half) = isAcross ? (walls.x, walls.y) : (walls.y, walls.x)
    let (a, z) = (Float(half), Float(-distance))
    let (low, high) = (Float(floor), Float(height))
    return Mesh(
      positions: [[-a, low, z], [a, low, z], [a, high, z], [-a, high, z]],
      normals: Array(repeating: [0, 0, 1], count: 4),
      triangles: [Triangle(0, 1, 2), Triangle(0, 2, 3)]
    ).placed(turned: angle, at: .zero)
  }
}
