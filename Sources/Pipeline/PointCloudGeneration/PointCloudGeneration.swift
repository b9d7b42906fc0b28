import Kernels
import SceneModel

/// Patch multi-view stereo: seeds patches from the sparse points, optimises and expands them over
/// every view, filters them by visibility and fuses them to one oriented, coloured cloud.
///
/// Y. Furukawa, J. Ponce: Accurate, dense, and robust multiview stereopsis, PAMI 2010. The schedule
/// is our own: a grid of patches a view, coarse to fine, which makes the stage parallel by view.
package struct PointCloudGeneration {
  package struct Options: Hashable, Codable, Sendable {
    /// Pixels of a view at the finest level.
    package var maximumPixelsPerView = 1_000_000
    package var patches = PatchStereo.Options()
    package var filter = PatchStereo.FilterOptions()
    /// Share of the photos' pixels below which the cloud is called sparse in a warning.
    package var sparseRatio = 0.05

    package init(maximumPixelsPerView: Int = 1_000_000) {
      self.maximumPixelsPerView = maximumPixelsPerView
    }
  }

  package var options: Options

  package init(options: Options = Options()) {
    self.options = options
  }

  package func run(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> PointCloud {
    let sources = SourceSelection().run(reconstruction)
    let nodes = try prepare(reconstruction, sources, images, context.part(from: 0, to: 0.05))
    try makePatches(nodes, of: reconstruction, context.part(from: 0.05, to: 0.8))
    try filter(nodes, context.part(from: 0.8, to: 0.9))
    let cloud = try fuse(nodes, context.part(from: 0.9, to: 1))
    guard cloud.count > 0 else {
      throw PipelineError.noSurface(
        reason: "no patch of surface looks alike in three photos or more.")
    }
    context.notes.count("points", Double(cloud.count))
    context.notes.count("views", Double(nodes.count))
    return cloud
  }

  /// A view's map and those of its sources, the best first.
  private struct Node: Sendable {
    var map: PatchMap
    var neighbors: [PatchMap]
  }

  /// Loads every view that has sources, free of distortion and at the stage's resolution.
  private func prepare(
    _ reconstruction: Reconstruction, _ sources: [[ID<Photo>]], _ images: ImageStore,
    _ context: StageContext
  ) throws -> [Node] {
    let photos = reconstruction.registered.filter { !sources[$0.index].isEmpty }
    guard !photos.isEmpty else {
      throw PipelineError.noSurface(reason: "no two photos share enough points.")
    }
    let position = Dictionary(uniqueKeysWithValues: photos.enumerated().map { ($1, $0) })
    let maps = try context.control.parallelMap(photos.count) { [options] index in
      PatchMap(
        view: PatchView(
          try images.pinholeView(
            photos[index], of: reconstruction, maximumPixels: options.maximumPixelsPerView)))
    }
    return maps.enumerated().map { index, map in
      let neighbors = sources[photos[index].index].compactMap { position[$0] }.map { maps[$0] }
      return Node(map: map, neighbors: neighbors)
    }
  }

  /// Seeds, optimises and expands, view by view.
  private func makePatches(
    _ nodes: [Node], of reconstruction: Reconstruction, _ context: StageContext
  ) throws {
    let seeds = seeds(of: reconstruction)
    _ = try context.control.parallelMap(nodes.count) { [options] index in
      let map = nodes[index].map
      let start = Double(index) / Double(nodes.count)
      do {
        try PatchStereo.reconstruct(
          map, sources: nodes[index].neighbors.map(\.view),
          seeds: seeds[map.view.photo.index].compactMap { map.view.seed(at: $0) },
          options: options.patches,
          control: context.control.part(from: start, to: start + 1 / Double(nodes.count)))
      } catch KernelError.degenerate {
        // A view that shows none of its sparse points gives no patches; others may do without it.
      }
    }
  }

  private func filter(_ nodes: [Node], _ context: StageContext) throws {
    _ = try context.control.parallelMap(nodes.count) { [options] index in
      try PatchStereo.filter(
        nodes[index].map, neighbors: nodes[index].neighbors, options: options.filter,
        control: context.control)
    }
    let pixels = nodes.reduce(0) { $0 + $1.map.view.width * $1.map.view.height }
    let accepted = nodes.reduce(0) { $0 + $1.map.acceptedCount }
    let ratio = Double(accepted) / Double(max(1, pixels))
    context.notes.count("acceptedPixelRatio", ratio)
    if ratio < options.sparseRatio {
      context.notes.warn(
        "Only \((1000 * ratio).rounded() / 10) % of the photos' area could be measured, so the "
          + "model has large gaps: take more photos, from places further to the side of each other."
      )
    }
    context.notes.count("viewMegapixels", Double(pixels) / 1e6)
  }

  private func fuse(_ nodes: [Node], _ context: StageContext) throws -> PointCloud {
    let parts = try context.control.parallelMap(nodes.count) { [options] index in
      try PatchStereo.fuse(
        nodes[index].map, neighbors: nodes[index].neighbors, options: options.filter,
        control: context.control)
    }
    return parts.reduce(into: PointCloud()) { $0.append($1) }
  }

  /// The sparse points that each photo observes, by photo id.
  private func seeds(of reconstruction: Reconstruction) -> [[SIMD3<Double>]] {
    var seeds = [[SIMD3<Double>]](repeating: [], count: reconstruction.photos.count)
    for point in reconstruction.points {
      for observation in point.track { seeds[observation.photo.index].append(point.position) }
    }
    return seeds
  }
}

extension PatchView {
  /// The seed of a sparse point; nil behind the camera.
  fileprivate func seed(at point: SIMD3<Double>) -> PatchSeed? {
    let seen = cameraFromWorld * point
    guard seen.z > 0 else { return nil }
    return PatchSeed(pixel: SIMD2<Float>(camera.project(seen)), inverseDepth: Float(1 / seen.z))
  }
}
