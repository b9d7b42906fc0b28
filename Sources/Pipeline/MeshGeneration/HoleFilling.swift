import Foundation
import SceneModel

/// Fills the holes that trimming leaves, except those that are observed free space.
///
/// The Poisson surface itself fills a small hole best. Over a large one it bulges like a balloon;
/// there it is replaced by a membrane, each vertex at the mean of its neighbors (a harmonic fill).
/// Where the hole of an object is near its support plane, it is projected onto the plane.
struct HoleFilling {
  struct Options: Hashable, Codable, Sendable {
    /// Fill holes of any size, for an object, which has an inside.
    var fillsLarge = true
    /// A hole with an extent below this share of the surface's is small. Chosen.
    var smallShare = 0.05
    /// A hole below this share is filled regardless of free space: a passage through an object is
    /// not a hole in its surface. Chosen.
    var tinyShare = 0.015
    /// Maximum share of a small hole's area in free space for it to be filled. Chosen.
    var smallFreeShare = 0.05
    /// The same for a membrane. Chosen.
    var membraneFreeShare = 0.2
    /// Openings of a membrane that photos see through stay open from this share of its area on.
    /// Chosen.
    var minimumOpeningShare = 0.01
    /// What stands for the extent of the surface; nil is that of the mesh. `SurfaceTrimming` sets
    /// it for a part of a surface.
    var extent: Float?
    /// How far below the hole free space is evaluated, in world units: rays that graze the surface
    /// don't reach this depth. Chosen: `SurfaceTrimming` sets it to the side of a cell.
    var depth: Float = 0
    /// Surface below this share of the object's height above its support was in contact with it.
    /// Rays that pass just above the support are no evidence of a hole. Chosen.
    var contactShare = 0.02
    /// Vertices within this many edges of a hole's boundary are not projected onto the support.
    /// Chosen.
    var boundaryMargin = 6
    /// Maximum number of solver iterations for a membrane. Chosen.
    var iterations = 400

    init() {}
  }

  var options = Options()

  /// Drops the faces marked in `isRemoved`, except those that fill a hole. `isFree` indicates
  /// whether photos observe free space at a point (world frame); `support` is the plane that the
  /// object stands on, if any.
  func run(
    _ mesh: Mesh, isRemoved: [Bool], support: SupportPlane? = nil,
    isFree: (SIMD3<Float>) throws -> Bool
  ) rethrows -> Mesh {
    guard let bounds = mesh.bounds, isRemoved.contains(true) else { return mesh }
    let size = options.extent ?? (bounds.max - bounds.min).length
    // A surface that leaves the solved cube is open there; with caps added, it fills holes too.
    let caps = mesh.caps(isRemoved: isRemoved)
    let (mesh, isRemoved) = (mesh.adding(caps), isRemoved + caps.triangles.map { _ in true })
    let holes = SurfaceHoles(mesh, isRemoved: isRemoved)
    let contact = support.map { Contact($0, under: mesh, isRemoved, share: options.contactShare) }
    var (result, isDropped) = (mesh, isRemoved)
    for hole in 0..<holes.count where holes.isEnclosed[hole] {
      let faces = holes.faces(of: hole)
      guard let isOpen = try fill(faces, hole, holes, size, contact, &result, isFree) else {
        continue
      }
      for (face, isOpen) in zip(faces, isOpen) { isDropped[face] = isOpen }
    }
    result.triangles = mesh.triangles.indices.filter { !isDropped[$0] }.map { mesh.triangles[$0] }
    return result
  }

  /// Gives the faces of a hole their final shape, and returns which of them stay open; nil if all
  /// of them do.
  private func fill(
    _ faces: [Int], _ hole: Int, _ holes: SurfaceHoles, _ size: Float, _ contact: Contact?,
    _ mesh: inout Mesh, _ isFree: (SIMD3<Float>) throws -> Bool
  ) rethrows -> [Bool]? {
    let triangles = faces.map { mesh.triangles[$0] }
    let closed = triangles.map { _ in false }
    let share = mesh.extent(of: triangles).map { Double($0 / size) } ?? 1
    let isSmall = share < options.smallShare
    guard isSmall || options.fillsLarge else { return nil }
    // A bulge with more area than the surface around it isn't a hole: stray samples caused it.
    if isSmall, holes.areas[hole] > holes.adjacentAreas[hole] { return nil }
    let depth = options.depth
    if isSmall,
      try mesh.freeShare(of: triangles, nil, depth: depth, isFree) < options.smallFreeShare
    {
      return closed
    }
    relax(triangles, of: &mesh, holes.isBoundary, contact)
    if share < options.tinyShare && options.fillsLarge { return closed }
    let freeShare = try mesh.freeShare(of: triangles, contact, depth: depth, isFree)
    guard freeShare < options.membraneFreeShare else { return nil }
    return try openings(of: triangles, in: mesh, contact, isFree)
  }

  /// Which faces of a membrane photos see through, in regions of sufficient size with smooth
  /// boundaries.
  private func openings(
    of faces: [Triangle], in mesh: Mesh, _ contact: Contact?,
    _ isFree: (SIMD3<Float>) throws -> Bool
  ) rethrows -> [Bool] {
    let isContradicted = try faces.map {
      try mesh.freeShare(of: [$0], contact, depth: options.depth, isFree) > 0
    }
    let membrane = Mesh(positions: mesh.positions, triangles: faces)
    var isOpen = BoundarySmoothing().run(membrane, isRemoved: isContradicted) { _ in true }
    let open = faces.indices.filter { isOpen[$0] }
    let areas = membrane.triangleAreas()
    let regions = MeshComponents(
      open.map { faces[$0] }, vertexCount: mesh.positions.count)
    var regionAreas = [Float](repeating: 0, count: regions.count)
    for (face, region) in zip(open, regions.components) {
      regionAreas[Int(region)] += areas[face]
    }
    let minimum = Float(options.minimumOpeningShare) * areas.reduce(0, +)
    for (face, region) in zip(open, regions.components) where regionAreas[Int(region)] < minimum {
      isOpen[face] = false
    }
    return isOpen
  }

  /// Spans a membrane across a hole, and projects its contact area onto the support. Not up to the
  /// boundary, which is as uneven as the photos' coverage of the lowest part.
  private func relax(
    _ triangles: [Triangle], of mesh: inout Mesh, _ isBoundary: [Bool], _ contact: Contact?
  ) {
    let membrane = MembraneFill(triangles, isFixed: isBoundary)
    membrane.relax(&mesh.positions, iterations: options.iterations)
    guard let contact else { return }
    var isFixed = isBoundary
    let isNearBoundary = triangles.vertices(within: options.boundaryMargin, of: isBoundary)
    for vertex in membrane.vertices where !isNearBoundary[vertex] {
      if contact.touches(mesh.positions[vertex]) {
        mesh.positions[vertex] = contact.projection(of: mesh.positions[vertex])
        isFixed[vertex] = true
      }
    }
    MembraneFill(triangles, isFixed: isFixed).relax(&mesh.positions, iterations: options.iterations)
  }
}

/// The contact of an object with its support.
private struct Contact {
  private let plane: SupportPlane
  private let limit: Double

  init(_ plane: SupportPlane, under mesh: Mesh, _ isRemoved: [Bool], share: Double) {
    self.plane = plane
    var top = 0.0
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) where !isRemoved {
      top = max(top, plane.height(of: SIMD3<Double>(mesh.positions[Int(triangle.a)])))
    }
    limit = max(2 * plane.band, share * top)
  }

  /// Whether a point is near enough to the support to have been in contact with it.
  func touches(_ point: SIMD3<Float>) -> Bool { plane.height(of: SIMD3<Double>(point)) < limit }

  /// The orthogonal projection of a point onto the support.
  func projection(of point: SIMD3<Float>) -> SIMD3<Float> {
    let point = SIMD3<Double>(point)
    return SIMD3<Float>(point - plane.height(of: point) * plane.normal)
  }
}

extension Mesh {
  /// The share of some faces' area that lies in free space and not in contact with the support.
  fileprivate func freeShare(
    of faces: [Triangle], _ contact: Contact?, depth: Float,
    _ isFree: (SIMD3<Float>) throws -> Bool
  ) rethrows -> Double {
    var (free, all) = (0.0, 0.0)
    for face in faces {
      let (a, b, c) = corners(of: face)
      let normal = (b - a).cross(c - a)
      let area = Double(normal.length)
      all += area
      if let contact, contact.touches(a), contact.touches(b), contact.touches(c) { continue }
      if try isFree(center(of: face) - depth * normal.normalized) { free += area }
    }
    return all > 0 ? free / all : 0
  }

  /// The diagonal of the box around the centers of some faces.
  fileprivate func extent(of faces: [Triangle]) -> Float? {
    Mesh(positions: faces.map { center(of: $0) }).bounds.map { ($0.max - $0.min).length }
  }
}
