import Foundation
import Kernels
import SceneModel

/// Removes what Poisson made up: faces far from any sample, and faces that photos see through.
///
/// A face that photos see through lies before a point that they see. Small gaps of the samples that
/// no photo sees through stay closed.
struct SurfaceTrimming {
  struct Options: Hashable, Codable, Sendable {
    /// A face this many spacings from the nearest sample has no support.
    var maximumSpacings = 4.0
    /// A face without support stays if it belongs to a patch of less than this share of the model's
    /// size across, and nobody sees through it.
    var gapShare = 0.06
    /// Faces this many spacings from any sample go where photos see through them.
    var contradictedSpacings = 1.5
    /// Photos that must see through a face.
    var contradictingPhotos = 3
    /// How far before its point a ray ends, in spacings.
    var clearanceSpacings = 5.0
    /// Points that rays are cast to, at most.
    var maximumRayPoints = 120_000

    init() {}
  }

  var options = Options()

  /// `samples` support the surface; `scene` is all that photos see, the background included.
  func run(
    _ mesh: Mesh, samples: PointCloud, scene: PointCloud, spacing: Double,
    _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> Mesh {
    let distances = try relativeDistances(
      mesh, samples, spacing, context.control.part(from: 0, to: 0.4))
    let counts = try seenThrough(
      mesh, scene, spacing, reconstruction, context.control.part(from: 0.4, to: 0.8))
    var isRemoved = mesh.triangles.indices.map { index in
      let t = mesh.triangles[index]
      let distance = max(distances[Int(t.a)], distances[Int(t.b)], distances[Int(t.c)])
      let isContradicted =
        Int(counts[index]) >= options.contradictingPhotos
        && distance > Float(options.contradictedSpacings)
      return isContradicted || distance > Float(options.maximumSpacings)
    }
    let isContradicted = counts.map { Int($0) >= options.contradictingPhotos }
    restoreGaps(&isRemoved, isContradicted, mesh)
    try context.control.step(0.95)
    let removed = isRemoved.filter { $0 }.count
    context.notes.count(
      "trimmedShare", Double(removed) / Double(max(1, mesh.triangles.count)))
    var result = mesh
    result.triangles = mesh.triangles.indices.filter { !isRemoved[$0] }.map { mesh.triangles[$0] }
    return result
  }

  /// Each vertex's distance to the nearest sample in units of that sample's spacing.
  private func relativeDistances(
    _ mesh: Mesh, _ samples: PointCloud, _ spacing: Double, _ control: KernelControl
  ) throws -> [Float] {
    let nearest = try NearestPoints(of: mesh.positions, in: samples.positions, control)
    return mesh.positions.indices.map { index in
      let sample = nearest.indices[index]
      guard sample >= 0 else { return .infinity }
      let footprint = samples.footprints[Int(sample)]
      return nearest.distances[index] / max(Float(spacing), footprint)
    }
  }

  private func seenThrough(
    _ mesh: Mesh, _ scene: PointCloud, _ spacing: Double, _ reconstruction: Reconstruction,
    _ control: KernelControl
  ) throws -> [UInt16] {
    let step = max(1, scene.count / max(1, options.maximumRayPoints))
    var targets = PointCloud()
    for index in stride(from: 0, to: scene.count, by: step) { targets.append(scene, index) }
    let clearances = targets.footprints.map {
      Float(options.clearanceSpacings) * max(Float(spacing), $0)
    }
    let centers = reconstruction.poses.map { SIMD3<Float>($0?.center ?? .zero) }
    return try mesh.photosSeeingThrough(
      to: targets, clearances: clearances, centers: centers, control)
  }

  /// Puts removed patches back that close a small gap.
  private func restoreGaps(_ isRemoved: inout [Bool], _ isContradicted: [Bool], _ mesh: Mesh) {
    guard let bounds = mesh.bounds else { return }
    let limit = Float(options.gapShare) * (bounds.max - bounds.min).length
    let removed = mesh.triangles.indices.filter { isRemoved[$0] }
    let patches = MeshComponents(
      removed.map { mesh.triangles[$0] }, vertexCount: mesh.positions.count)
    let members = Members(of: patches.components, count: patches.count)
    for patch in 0..<patches.count {
      let faces = members[patch].map { removed[Int($0)] }
      let contradicted = faces.filter { isContradicted[$0] }.count
      guard contradicted * 20 < faces.count else { continue }
      let corners = faces.flatMap {
        [mesh.triangles[$0].a, mesh.triangles[$0].b, mesh.triangles[$0].c]
      }
      guard let box = Mesh(positions: corners.map { mesh.positions[Int($0)] }).bounds,
        (box.max - box.min).length < limit
      else { continue }
      for face in faces { isRemoved[face] = false }
    }
  }
}
