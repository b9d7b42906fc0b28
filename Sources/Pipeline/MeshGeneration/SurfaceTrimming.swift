import Foundation
import Kernels
import SceneModel

/// Removes surface that Poisson reconstruction extrapolated: faces far from any sample, weakly
/// supported faces in observed free space, and what the masks exclude. `BoundarySmoothing` smooths
/// the boundary; `HoleFilling` decides which of the holes are filled again.
struct SurfaceTrimming {
  struct Options: Hashable, Codable, Sendable {
    /// Faces farther than this many spacings from the nearest sample are unsupported.
    var maximumSpacings = 2.5
    /// Faces farther than this many spacings from any sample are removed if photos see through
    /// them.
    var contradictedSpacings = 1.5
    /// Number of photos that must see through a face.
    var contradictingPhotos = 3
    /// Maximum distance from a sample, in spacings, at which a notch in the boundary is filled.
    var notchSpacings = 5.0
    /// How far in front of its point a ray ends, in spacings.
    var clearanceSpacings = 5.0
    /// Side of the free-space cells, in spacings.
    var cellSpacings = 2.0
    /// Maximum number of points that rays are cast to.
    var maximumRayPoints = 500_000
    var boundary = BoundarySmoothing.Options()
    var holeFilling = HoleFilling.Options()

    init() {}
  }

  var options = Options()

  /// `samples` support the surface; `scene` is all that the photos observe, including the
  /// background; `spacing` is the sample spacing in world units; `support` is the plane that the
  /// object stands on.
  func run(
    _ mesh: Mesh, samples: PointCloud, scene: PointCloud, spacing: Double,
    support: SupportPlane? = nil, silhouettes: Silhouettes? = nil,
    _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> Mesh {
    guard let bounds = mesh.bounds else { return mesh }
    let notes = context.notes
    let distances = try notes.step("sampleDistances") {
      try self.distances(mesh, samples, spacing, context.control.part(from: 0, to: 0.4))
    }
    let freeSpace = try notes.step("freeSpace") {
      try self.freeSpace(
        bounds, scene, spacing, reconstruction, context.control.part(from: 0.4, to: 0.8))
    }
    let isInside = try silhouettes?.areInside(
      mesh.triangles.map { mesh.center(of: $0) }, context.control.part(from: 0.8, to: 0.8))
    let isSeenThrough = { freeSpace.photos(at: $0) >= options.contradictingPhotos }
    var isRemoved = mesh.triangles.indices.map { index in
      let triangle = mesh.triangles[index]
      let distance = triangle.maximum(of: distances)
      return distance > Float(options.maximumSpacings) || isInside?[index] == false
        || distance > Float(options.contradictedSpacings)
          && isSeenThrough(mesh.center(of: triangle))
    }
    isRemoved = notes.step("boundarySmoothing") {
      BoundarySmoothing(options: options.boundary).run(mesh, isRemoved: isRemoved) { index in
        let triangle = mesh.triangles[index]
        return triangle.maximum(of: distances) <= Float(options.notchSpacings)
          && isInside?[index] != false && !isSeenThrough(mesh.center(of: triangle))
          && support.map { $0.height(of: SIMD3<Double>(mesh.center(of: triangle))) > 0 } ?? true
      }
    }
    try context.control.step(0.9)
    context.notes.record(
      "trimmedShare",
      Double(isRemoved.count { $0 }) / Double(max(1, mesh.triangles.count)))
    var holeFilling = HoleFilling(options: options.holeFilling)
    holeFilling.options.depth = Float(freeSpace.cellSize)
    return notes.step("holeFilling") {
      holeFilling.run(mesh, isRemoved: isRemoved, support: support) { point in
        isSeenThrough(point) || silhouettes?.isInside(SIMD3<Double>(point)) == false
      }
    }
  }

  /// Each vertex's distance to the nearest sample, in units of that sample's spacing.
  private func distances(
    _ mesh: Mesh, _ samples: PointCloud, _ spacing: Double, _ control: KernelControl
  ) throws -> [Float] {
    let nearest = try NearestPoints(of: mesh.positions, in: samples.positions, control)
    return mesh.positions.indices.map { index -> Float in
      let sample = nearest.indices[index]
      guard sample >= 0 else { return .infinity }
      return nearest.distances[index] / max(Float(spacing), samples.footprints[Int(sample)])
    }
  }

  /// Casts rays from the camera centers to a subset of the scene's points, and counts the photos
  /// that see through each cell.
  private func freeSpace(
    _ bounds: (min: SIMD3<Float>, max: SIMD3<Float>), _ scene: PointCloud, _ spacing: Double,
    _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws -> FreeSpace {
    let step = max(1, scene.count / max(1, options.maximumRayPoints))
    var targets = PointCloud()
    for index in stride(from: 0, to: scene.count, by: step) { targets.append(scene, index) }
    let clearances = targets.footprints.map {
      Float(options.clearanceSpacings) * max(Float(spacing), $0)
    }
    return try FreeSpace(
      low: bounds.min, high: bounds.max, cellSize: options.cellSpacings * spacing, cloud: targets,
      clearances: clearances,
      centers: reconstruction.poses.map { SIMD3<Float>($0?.center ?? .zero) }, control)
  }
}

extension Triangle {
  /// The maximum of the corners' values.
  fileprivate func maximum(of values: [Float]) -> Float {
    max(values[Int(a)], values[Int(b)], values[Int(c)])
  }
}
