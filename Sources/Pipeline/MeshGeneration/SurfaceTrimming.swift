import Foundation
import Kernels
import SceneModel

/// Removes what Poisson made up: faces without support that photos see through, that photos should
/// see and don't, that masks leave out, or that are too far from any sample.
///
/// What no photo could see stays as Poisson closed it where an object is to be closed.
struct SurfaceTrimming {
  struct Options: Hashable, Codable, Sendable {
    /// Keep what no photo could see, so that the object is closed.
    var closesUnseen = true
    /// A face this many spacings from the nearest sample has no support.
    var maximumSpacings = 4.0
    /// Unseen faces this share of the model's size from any sample go.
    var unseenShare = 0.08
    /// A removed patch of less than this share of the model's size across is put back unless photos
    /// see through it.
    var gapShare = 0.05
    /// Faces this many spacings from any sample go where photos see through them.
    var contradictedSpacings = 1.5
    /// The same for faces of the base: rays to the support graze it.
    var contradictedBaseSpacings = 8.0
    /// Photos that must see through a face.
    var contradictingPhotos = 3
    /// Photos that must face a face for it to be one that is seen.
    var viewingPhotos = 3
    /// The cosine between the direction to a photo that faces a face and its normal.
    var viewingCosine = 0.3
    /// How far before its point a ray ends, in spacings.
    var clearanceSpacings = 5.0
    /// Points that rays are cast to, at most.
    var maximumRayPoints = 120_000

    init() {}
  }

  var options = Options()

  /// `samples` support the surface; `scene` is all that photos see, the background included. Faces
  /// for which `isBase` says so stay unless photos see through them.
  func run(
    _ mesh: Mesh, samples: PointCloud, scene: PointCloud, spacing: Double,
    isBase: (SIMD3<Float>) -> Bool = { _ in false }, silhouettes: Silhouettes? = nil,
    _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> Mesh {
    guard let bounds = mesh.bounds else { return mesh }
    let size = (bounds.max - bounds.min).length
    let (relative, absolute) = try distances(
      mesh, samples, spacing, context.control.part(from: 0, to: 0.4))
    let counts = try seenThrough(
      mesh, scene, spacing, reconstruction, context.control.part(from: 0.4, to: 0.8))
    let centers = mesh.triangles.map { mesh.center(of: $0) }
    let isBaseFace = centers.map(isBase)
    let isInside = try silhouettes?.areInside(centers, context.control.part(from: 0.8, to: 0.8))
    let isContradicted = mesh.triangles.indices.map { index in
      if let isInside, !isInside[index] { return true }
      let limit =
        isBaseFace[index] ? options.contradictedBaseSpacings : options.contradictedSpacings
      return Int(counts[index]) >= options.contradictingPhotos
        && mesh.triangles[index].maximum(of: relative) > Float(limit)
    }
    var isRemoved = mesh.triangles.indices.map { index in
      isContradicted[index]
        || mesh.triangles[index].maximum(of: relative) > Float(options.maximumSpacings)
    }
    if options.closesUnseen {
      let limit = Float(options.unseenShare) * size
      let doubtful = mesh.triangles.indices.filter {
        isRemoved[$0] && !isContradicted[$0] && mesh.triangles[$0].maximum(of: absolute) < limit
      }
      let isUnseen = try areUnseen(
        doubtful, of: mesh, spacing, reconstruction, context.control.part(from: 0.8, to: 0.9))
      for (face, isUnseen) in zip(doubtful, isUnseen) where isUnseen || isBaseFace[face] {
        isRemoved[face] = false
      }
    }
    restoreGaps(&isRemoved, isContradicted, mesh, limit: Float(options.gapShare) * size)
    try context.control.step(0.95)
    let removed = isRemoved.filter { $0 }.count
    context.notes.count("trimmedShare", Double(removed) / Double(max(1, mesh.triangles.count)))
    var result = mesh
    result.triangles = mesh.triangles.indices.filter { !isRemoved[$0] }.map { mesh.triangles[$0] }
    return result
  }

  /// Each vertex's distance to the nearest sample, in units of that sample's spacing and as it is.
  private func distances(
    _ mesh: Mesh, _ samples: PointCloud, _ spacing: Double, _ control: KernelControl
  ) throws -> (relative: [Float], absolute: [Float]) {
    let nearest = try NearestPoints(of: mesh.positions, in: samples.positions, control)
    let relative = mesh.positions.indices.map { index -> Float in
      let sample = nearest.indices[index]
      guard sample >= 0 else { return .infinity }
      let footprint = samples.footprints[Int(sample)]
      return nearest.distances[index] / max(Float(spacing), footprint)
    }
    return (relative, nearest.distances)
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

  /// Whether too few photos face each of some faces for it to be one that they would have measured.
  private func areUnseen(
    _ faces: [Int], of mesh: Mesh, _ spacing: Double, _ reconstruction: Reconstruction,
    _ control: KernelControl
  ) throws -> [Bool] {
    let photos = reconstruction.registered.compactMap { id in
      reconstruction.poses[id.index].map {
        ViewingPhoto(reconstruction.camera(of: id), cameraFromWorld: $0)
      }
    }
    let counts = try mesh.viewingPhotos(
      of: faces.map { mesh.center(of: mesh.triangles[$0]) },
      normals: faces.map { mesh.normal(of: mesh.triangles[$0]) }, photos: photos,
      minimumCosine: Float(options.viewingCosine), clearance: Float(0.5 * spacing), control)
    return counts.map { Int($0) < options.viewingPhotos }
  }

  /// Puts removed patches back that close a small gap.
  private func restoreGaps(
    _ isRemoved: inout [Bool], _ isContradicted: [Bool], _ mesh: Mesh, limit: Float
  ) {
    let removed = mesh.triangles.indices.filter { isRemoved[$0] }
    let patches = MeshComponents(
      removed.map { mesh.triangles[$0] }, vertexCount: mesh.positions.count)
    let members = Members(of: patches.components, count: patches.count)
    for patch in 0..<patches.count {
      let faces = members[patch].map { removed[Int($0)] }
      let contradicted = faces.filter { isContradicted[$0] }.count
      guard contradicted * 20 < faces.count,
        let box = Mesh(positions: faces.map { mesh.center(of: mesh.triangles[$0]) }).bounds,
        (box.max - box.min).length < limit
      else { continue }
      for face in faces { isRemoved[face] = false }
    }
  }
}

extension Triangle {
  /// The largest of the corners' values.
  fileprivate func maximum(of values: [Float]) -> Float {
    max(values[Int(a)], values[Int(b)], values[Int(c)])
  }
}

extension Mesh {
  fileprivate func center(of triangle: Triangle) -> SIMD3<Float> {
    let (a, b, c) = corners(of: triangle)
    return (a + b + c) / 3
  }

  /// Unit normal; zero for a triangle without area.
  fileprivate func normal(of triangle: Triangle) -> SIMD3<Float> {
    let (a, b, c) = corners(of: triangle)
    return (b - a).cross(c - a).normalized
  }
}
