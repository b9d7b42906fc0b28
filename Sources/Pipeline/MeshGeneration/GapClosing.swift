import Foundation
import SceneModel

/// Closes the gaps that trimming leaves, but for those that photos look through.
///
/// Poisson's own surface closes a small gap best. Over a large one it bulges like a balloon; there
/// it is drawn taut, each vertex at the mean of its neighbours: a membrane across the gap. What of it
/// is close above the support of an object stood on it.
struct GapClosing {
  struct Options: Hashable, Codable, Sendable {
    /// Close gaps of any size, as of an object, which has an inside.
    var closesLarge = true
    /// A gap of less than this share of the surface's size across is small.
    var smallShare = 0.05
    /// One of less than this is closed whatever photos look through: the way through an object that
    /// they show is not a hole in its skin.
    var tinyShare = 0.015
    /// The share of a gap's area that photos may look through for it to be closed.
    var smallFreeShare = 0.05
    /// The same for a membrane.
    var membraneFreeShare = 0.2
    /// How far behind a gap it is seen whether photos look through it, in world units: a ray that
    /// grazes the surface doesn't get there.
    var depth: Float = 0
    /// What is lower than this share of the object's height above its support touched it. Rays that
    /// pass just above the support don't tell that there is a hole.
    var contactShare = 0.02
    /// What is so many edges from a gap's rim, or fewer, is not put down on the support.
    var bevel = 6
    /// Iterations of the solver at most, for a membrane.
    var iterations = 400

    init() {}
  }

  var options = Options()

  /// Drops the faces for which `isRemoved` says so, less those that close a gap. `isFree` tells
  /// whether photos look through a place; `support` is what the object stands on, if anything.
  func run(
    _ mesh: Mesh, isRemoved: [Bool], support: StandingPlane? = nil,
    isFree: (SIMD3<Float>) -> Bool
  ) -> Mesh {
    guard let bounds = mesh.bounds, isRemoved.contains(true) else { return mesh }
    let size = (bounds.max - bounds.min).length
    // What bulges out of the solved cube ends there: with a lid on, it closes a gap, too.
    let lid = mesh.lid(isRemoved: isRemoved)
    let (mesh, isRemoved) = (mesh.adding(lid), isRemoved + lid.triangles.map { _ in true })
    let gaps = SurfaceGaps(mesh, isRemoved: isRemoved)
    let contact = support.map { Contact($0, under: mesh, isRemoved, share: options.contactShare) }
    var (result, isDropped) = (mesh, isRemoved)
    for gap in 0..<gaps.count where gaps.isEnclosed[gap] {
      if close(gap, gaps, size, contact, &result, isFree) {
        for face in gaps.faces(of: gap) { isDropped[face] = false }
      }
    }
    result.triangles = mesh.triangles.indices.filter { !isDropped[$0] }.map { mesh.triangles[$0] }
    return result
  }

  /// Gives the faces of a gap the shape that closes it; false where it is to stay open.
  private func close(
    _ gap: Int, _ gaps: SurfaceGaps, _ size: Float, _ contact: Contact?, _ mesh: inout Mesh,
    _ isFree: (SIMD3<Float>) -> Bool
  ) -> Bool {
    let triangles = gaps.faces(of: gap).map { mesh.triangles[$0] }
    let share = mesh.extent(of: triangles).map { Double($0 / size) } ?? 1
    let isSmall = share < options.smallShare
    guard isSmall || options.closesLarge else { return false }
    // A balloon with more surface than what holds it is no gap: stray samples made it.
    if isSmall, gaps.areas[gap] > gaps.rimAreas[gap] { return false }
    func freeShare(_ contact: Contact? = nil) -> Double {
      mesh.freeShare(of: triangles, contact, depth: options.depth, isFree)
    }
    if isSmall, freeShare() < options.smallFreeShare { return true }
    tighten(triangles, of: &mesh, gaps.isRim, contact)
    let isTiny = share < options.tinyShare && options.closesLarge
    return isTiny || freeShare(contact) < options.membraneFreeShare
  }

  /// Draws a membrane across a gap, and what of it touched the support down to it: not up to the
  /// rim, which is as uneven as what photos see of the lowest part.
  private func tighten(
    _ triangles: [Triangle], of mesh: inout Mesh, _ isRim: [Bool], _ contact: Contact?
  ) {
    let membrane = Membrane(triangles, isFixed: isRim)
    membrane.tighten(&mesh.positions, iterations: options.iterations)
    guard let contact else { return }
    var isFixed = isRim
    let isNearRim = triangles.vertices(within: options.bevel, of: isRim)
    for vertex in membrane.vertices where !isNearRim[vertex] {
      if contact.reaches(mesh.positions[vertex]) {
        mesh.positions[vertex] = contact.foot(of: mesh.positions[vertex])
        isFixed[vertex] = true
      }
    }
    Membrane(triangles, isFixed: isFixed).tighten(&mesh.positions, iterations: options.iterations)
  }
}

/// Where an object touches its support.
private struct Contact {
  private let plane: StandingPlane
  private let limit: Double

  init(_ plane: StandingPlane, under mesh: Mesh, _ isRemoved: [Bool], share: Double) {
    self.plane = plane
    var top = 0.0
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) where !isRemoved {
      top = max(top, plane.height(of: SIMD3<Double>(mesh.positions[Int(triangle.a)])))
    }
    limit = max(2 * plane.band, share * top)
  }

  /// Whether a point is so close to the support that the object touched it there.
  func reaches(_ point: SIMD3<Float>) -> Bool { plane.height(of: SIMD3<Double>(point)) < limit }

  /// The place on the support straight below a point.
  func foot(of point: SIMD3<Float>) -> SIMD3<Float> {
    let point = SIMD3<Double>(point)
    return SIMD3<Float>(point - plane.height(of: point) * plane.normal)
  }
}

extension Mesh {
  /// The share of some faces' area that photos look through, and that is not in contact with the
  /// support.
  fileprivate func freeShare(
    of faces: [Triangle], _ contact: Contact?, depth: Float,
    _ isFree: (SIMD3<Float>) -> Bool
  ) -> Double {
    var (free, all) = (0.0, 0.0)
    for face in faces {
      let (a, b, c) = corners(of: face)
      let normal = (b - a).cross(c - a)
      let area = Double(normal.length)
      all += area
      if let contact, contact.reaches(a), contact.reaches(b), contact.reaches(c) { continue }
      if isFree(center(of: face) - depth * normal.normalized) { free += area }
    }
    return all > 0 ? free / all : 0
  }

  /// The diagonal of the box around some faces.
  fileprivate func extent(of faces: [Triangle]) -> Float? {
    Mesh(positions: faces.map { center(of: $0) }).bounds.map { ($0.max - $0.min).length }
  }
}
