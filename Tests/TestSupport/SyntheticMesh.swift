import Foundation
import SceneModel

/// Meshes of known shape.
package enum SyntheticMesh {
  /// A sphere around the origin: a subdivided octahedron with `8 · 4^subdivisions` triangles.
  package static func sphere(radius: Float = 1, subdivisions: Int) -> Mesh {
    var mesh = Mesh(
      positions: [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
      triangles: [
        .init(0, 2, 4), .init(2, 1, 4), .init(1, 3, 4), .init(3, 0, 4),
        .init(2, 0, 5), .init(1, 2, 5), .init(3, 1, 5), .init(0, 3, 5),
      ])
    for _ in 0..<subdivisions { mesh = subdivided(mesh) }
    mesh.positions = mesh.positions.map { $0.normalized * radius }
    mesh.normals = mesh.positions.map(\.normalized)
    return mesh
  }

  /// An axis-aligned cube of side 2 around the origin, each face made of `cells`² squares.
  package static func cube(cells: Int) -> Mesh {
    var mesh = Mesh()
    let axes: [(SIMD3<Float>, SIMD3<Float>)] = [
      ([0, 1, 0], [0, 0, 1]), ([0, 0, 1], [1, 0, 0]), ([1, 0, 0], [0, 1, 0]),
    ]
    for (u, v) in axes {
      let normal = u.cross(v)
      mesh.append(grid(cells: cells, origin: normal - u - v, u: 2 * u, v: 2 * v))
      mesh.append(grid(cells: cells, origin: -normal - u - v, u: 2 * v, v: 2 * u))
    }
    return welded(mesh)
  }

  /// A flat grid of `cells`² squares spanned by u and v; its front faces u × v.
  package static func grid(
    cells: Int, origin: SIMD3<Float>, u: SIMD3<Float>, v: SIMD3<Float>
  ) -> Mesh {
    var mesh = Mesh()
    for row in 0...cells {
      for column in 0...cells {
        let (s, t) = (Float(column) / Float(cells), Float(row) / Float(cells))
        mesh.positions.append(origin + s * u + t * v)
      }
    }
    let width = UInt32(cells + 1)
    for row in 0..<UInt32(cells) {
      for column in 0..<UInt32(cells) {
        let corner = row * width + column
        mesh.triangles.append(.init(corner, corner + 1, corner + width + 1))
        mesh.triangles.append(.init(corner, corner + width + 1, corner + width))
      }
    }
    mesh.normals = mesh.positions.map { _ in u.cross(v).normalized }
    return mesh
  }

  /// The mesh with coincident vertices merged, without normals.
  package static func welded(_ mesh: Mesh) -> Mesh {
    var known: [SIMD3<Float>: UInt32] = [:]
    var result = Mesh()
    let ids = mesh.positions.map { position -> UInt32 in
      // Rounded, so that sums in different orders coincide.
      let key = (position * 4096).rounded(.toNearestOrAwayFromZero)
      if let id = known[key] { return id }
      let id = UInt32(result.positions.count)
      result.positions.append(position)
      known[key] = id
      return id
    }
    result.triangles = mesh.triangles.map { .init(ids[Int($0.a)], ids[Int($0.b)], ids[Int($0.c)]) }
    return result
  }

  private static func subdivided(_ mesh: Mesh) -> Mesh {
    var result = Mesh(positions: mesh.positions)
    var middles: [SIMD2<UInt32>: UInt32] = [:]
    func middle(_ a: UInt32, _ b: UInt32) -> UInt32 {
      let key = SIMD2(min(a, b), max(a, b))
      if let known = middles[key] { return known }
      result.positions.append(
        (mesh.positions[Int(a)] + mesh.positions[Int(b)]).normalized)
      middles[key] = UInt32(result.positions.count - 1)
      return UInt32(result.positions.count - 1)
    }
    for t in mesh.triangles {
      let (ab, bc, ca) = (middle(t.a, t.b), middle(t.b, t.c), middle(t.c, t.a))
      result.triangles += [
        .init(t.a, ab, ca), .init(ab, t.b, bc), .init(ca, bc, t.c), .init(ab, bc, ca),
      ]
    }
    return result
  }
}

/// Photos of a unit sphere at the origin, taken from all sides, with exact cameras.
package struct SphereScene: Sendable {
  package var reconstruction: Reconstruction
  package var images: [RasterImage]

  /// `color` returns the RGB color, 0…255, of a point of the sphere; `gains` are applied per photo.
  package init(
    viewCount: Int, imageSize: Int = 200, gains: [Float] = [],
    color: (SIMD3<Float>) -> SIMD3<Float>
  ) {
    let side = Double(imageSize)
    let camera = Camera(width: imageSize, height: imageSize, focalLength: [1.8 * side, 1.8 * side])
    var photos: [Photo] = []
    var poses: [RigidTransform?] = []
    images = []
    for index in 0..<viewCount {
      let pose = Self.pose(index, of: viewCount)
      photos.append(
        Photo(
          id: ID(index), sampleID: index, name: "\(index)", url: URL(filePath: "/\(index)"),
          width: imageSize, height: imageSize, orientation: 1, camera: ID(0)))
      poses.append(pose)
      let gain = gains.isEmpty ? 1 : gains[index % gains.count]
      images.append(Self.render(camera, pose) { color($0) * gain })
    }
    reconstruction = Reconstruction(cameras: [camera], photos: photos, poses: poses, points: [])
  }

  /// Cameras on a spiral from pole to pole at distance 5, facing the origin.
  private static func pose(_ index: Int, of count: Int) -> RigidTransform {
    let height = 1 - 2 * (Double(index) + 0.5) / Double(count)
    let angle = 2.399963 * Double(index)
    let radius = (1 - height * height).squareRoot()
    let center = 5 * SIMD3(radius * cos(angle), height, radius * sin(angle))
    let forward = (-center).normalized
    let right = forward.cross([0.1, 1, 0.05]).normalized
    let down = forward.cross(right)
    let rotation = Quaternion(Matrix3(rows: right, down, forward))
    return RigidTransform(rotation: rotation, translation: -(rotation * center))
  }

  private static func render(
    _ camera: Camera, _ pose: RigidTransform, _ color: (SIMD3<Float>) -> SIMD3<Float>
  ) -> RasterImage {
    var image = RasterImage(
      width: camera.width, height: camera.height, channels: 3, filledWith: 20)
    let center = pose.center
    for y in 0..<camera.height {
      for x in 0..<camera.width {
        let p = camera.unproject([Double(x) + 0.5, Double(y) + 0.5])
        let direction = (pose.rotation.conjugate * SIMD3(p.x, p.y, 1)).normalized
        let b = center.dot(direction)
        let root = b * b - (center.squaredLength - 1)
        guard root >= 0 else { continue }
        let value = color(SIMD3<Float>(center + (-b - root.squareRoot()) * direction))
        for channel in 0..<3 {
          image.pixels[3 * (y * camera.width + x) + channel] =
            UInt8(min(max(value[channel].rounded(), 0), 255))
        }
      }
    }
    return image
  }
}
