import Foundation
import Kernels
import SceneModel

/// Removes surface that Poisson reconstruction extrapolated: faces far from any sample, weakly
/// supported faces in observed free space, and what the masks exclude. `BoundarySmoothing` smooths
/// the boundary; `HoleFilling` decides which of the holes are filled again.
struct SurfaceTrimming {
  struct Options: Hashable, Codable, Sendable {
    /// Faces farther than this many spacings from the nearest sample are unsupported. Chosen.
    var maximumSpacings = 2.5
    /// Faces farther than this many spacings from any sample are removed if photos see through
    /// them. Chosen.
    var contradictedSpacings = 1.5
    /// Number of photos that must see through a face. Chosen.
    var contradictingPhotos = 3
    /// Maximum distance from a sample, in spacings, at which a notch in the boundary is filled.
    /// Chosen.
    var notchSpacings = 5.0
    /// How far in front of its point a ray ends, in spacings. Chosen.
    var clearanceSpacings = 5.0
    /// Side of the free-space cells, in spacings. Chosen.
    var cellSpacings = 2.0
    /// Maximum number of points that rays are cast to. Chosen.
    var maximumRayPoints = 500_000
    var boundary = BoundarySmoothing.Options()
    var holeFilling = HoleFilling.Options()

    init() {}
  }

  var options = Options()

  /// `samples` support the surface; `scene` is all that the photos observe, including the
  /// background; `spacing` is the sample spacing in world units; `support` is the plane that the
  /// object stands on; `part` is given for a part of a surface.
  func run(
    _ mesh: Mesh, samples: PointCloud, scene: PointCloud, spacing: Double,
    support: SupportPlane? = nil, silhouettes: Silhouettes? = nil, part: SurfacePart? = nil,
    _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> Mesh {
    guard let bounds = mesh.bounds else { return mesh }
    let notes = context.notes
    // The boundary can follow the support only along edges.
    let mesh = support.map { mesh.split(where: $0.heights(of: mesh.positions)) } ?? mesh
    let nearest = try notes.step("sampleDistances") {
      try NearestPoints(
        of: mesh.positions, in: samples.positions, context.control.part(from: 0, to: 0.4))
    }
    let freeSpace = try notes.step("freeSpace") {
      try self.freeSpace(
        bounds, part, scene, spacing, reconstruction, context.control.part(from: 0.4, to: 0.8))
    }
    let isSeenThrough = { freeSpace.photos(at: $0) >= options.contradictingPhotos }
    var evidence = SurfaceEvidence(
      mesh, samples: samples, nearest: nearest, spacing: spacing, support: support,
      isSeenThrough: isSeenThrough)
    evidence.isInside = try silhouettes?.areInside(
      evidence.centers, context.control.part(from: 0.8, to: 0.8))
    let isRemoved = notes.step("boundarySmoothing") {
      BoundarySmoothing(options: options.boundary).run(
        mesh, isRemoved: mesh.triangles.indices.map { !isSupported($0, evidence) },
        isOutside: evidence.isBelowSupport
      ) { canFillNotch($0, evidence) }
    }
    try context.control.step(0.9)
    context.notes.record(
      "trimmedShare",
      Double(isRemoved.count { $0 }) / Double(max(1, mesh.triangles.count)))
    var holeFilling = HoleFilling(options: options.holeFilling)
    holeFilling.options.depth = Float(freeSpace.cellSize)
    holeFilling.options.extent = part?.extent
    return try notes.step("holeFilling") {
      try holeFilling.run(mesh, isRemoved: isRemoved, support: support) { point in
        try isSeenThrough(point) || silhouettes?.isInside(point) == false
      }
    }
  }

  /// Whether samples support a face that neither the masks nor photos contradict.
  private func isSupported(_ face: Int, _ evidence: SurfaceEvidence) -> Bool {
    let distance = evidence.distance(of: face)
    return distance <= Float(options.maximumSpacings) && evidence.isInside?[face] != false
      && evidence.isBelowSupport?[face] != true
      && (distance <= Float(options.contradictedSpacings) || !evidence.isSeenThrough(face))
  }

  /// Whether a face may fill a notch in the boundary.
  private func canFillNotch(_ face: Int, _ evidence: SurfaceEvidence) -> Bool {
    evidence.distance(of: face) <= Float(options.notchSpacings)
      && (evidence.isInside?[face] != false || evidence.isAtSupport(face))
      && !evidence.isSeenThrough(face)
  }

  /// The points of a scene's clouds that rays are cast to. Of these, all are taken.
  func rayTargets(in clouds: [PointCloud]) -> PointCloud {
    let step = max(1, clouds.reduce(0) { $0 + $1.count } / max(1, options.maximumRayPoints))
    var (targets, next) = (PointCloud(), 0)
    for cloud in clouds {
      while next < cloud.count {
        targets.append(cloud, next)
        next += step
      }
      next -= cloud.count
    }
    return targets
  }

  /// Casts rays from the camera centers to a subset of the scene's points, and counts the photos
  /// that see through each cell.
  private func freeSpace(
    _ bounds: (min: SIMD3<Float>, max: SIMD3<Float>), _ part: SurfacePart?, _ scene: PointCloud,
    _ spacing: Double, _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws -> FreeSpace {
    let targets = rayTargets(in: [scene])
    let clearances = targets.footprints.map {
      Float(options.clearanceSpacings) * max(Float(spacing), $0)
    }
    let centers = reconstruction.poses.map { SIMD3<Float>($0?.center ?? .zero) }
    guard let part else {
      return try FreeSpace(
        low: bounds.min, high: bounds.max, cellSize: options.cellSpacings * spacing,
        cloud: targets, clearances: clearances, centers: centers, control)
    }
    return try FreeSpace(
      low: SIMD3<Float>(part.low), high: SIMD3<Float>(part.high), origin: part.low,
      cellSize: part.freeSpaceCell, cloud: targets, clearances: clearances, centers: centers,
      control)
  }
}
