import Foundation
import Kernels
import SceneModel

/// Reconstructs the surface of the object, or of the whole scene, from the dense cloud.
///
/// Steps: isolate, downsample, Poisson, trim and fill holes, clean; each in its own file.
package struct MeshGeneration {
  /// Parameters of meshing.
  package struct Options: Hashable, Codable, Sendable {
    /// Keep the object that the photos are aimed at, and remove its support and background.
    package var isolatesObject = true
    /// Fill the unobserved parts of an isolated object; otherwise large holes stay open.
    package var closesObject = true
    /// Maximum octree depth; 9 resolves 1/460, 10 resolves 1/930 of the object's size. Chosen.
    package var maximumDepth = 9
    /// Share of photos with masks from which on the masks determine what is the object. Chosen.
    package var sufficientMaskShare = 0.5
    /// Minimum number of finite points of a cloud. Chosen.
    package var minimumPoints = 100
    var isolation = ObjectIsolation.Options()
    var sceneTrimming = SceneTrimming.Options()
    var downsampling = VoxelDownsampling.Options()
    /// Its depth is limited by `maximumDepth`.
    var poisson = PoissonSurface.Options()
    /// Large holes are filled only in an object, and if `closesObject` is set.
    var trimming = SurfaceTrimming.Options()
    var cleaning = MeshCleaning.Options()

    /// Number of pixels per view up to which the default depth suffices, and the largest depth for
    /// more. Chosen: the first is the medium level (`DetailSpecification`).
    private static let (basePixels, largestDepth) = (500_000, 12)

    package init() {}

    /// The options for a cloud from views of `viewPixels` pixels.
    package init(viewPixels: Int) { adapt(toViewPixels: viewPixels) }

    /// From 0.5 MP on, four times the pixels double the resolution of the octree.
    package mutating func adapt(toViewPixels viewPixels: Int) {
      let pixels = max(Self.basePixels, viewPixels)
      let finer = log2(Double(pixels) / Double(Self.basePixels)) / 2
      maximumDepth = min(Self.largestDepth, Self().maximumDepth + Int(finer.rounded()))
    }
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The surface with normals and colors, in the frame of the cloud. If most photos have masks, the
  /// object is what `silhouettes` retain; `support` is what it stands on, and `surroundings` are
  /// observed points around it, which prove that the space in front of them is free. `keep` gets
  /// what the surface is made from.
  ///
  /// Throws `PipelineError.noSurface` if the cloud does not determine one.
  func run(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, silhouettes: Silhouettes? = nil,
    support: SupportPlane? = nil, surroundings: PointCloud = PointCloud(),
    _ context: StageContext, keep: (SurfaceSystem) -> Void = { _ in }
  ) throws -> Mesh {
    let system = try system(
      of: cloud, reconstruction, silhouettes: silhouettes, support: support,
      context.part(from: 0, to: 0.66))
    keep(system)
    return try mesh(
      of: system, observed: observed(cloud, surroundings), reconstruction,
      silhouettes: silhouettes, context.part(from: 0.66, to: 1))
  }

  /// Of all that the photos observe, what proves that the space in front of it is free.
  func observed(_ cloud: PointCloud, _ surroundings: PointCloud) -> PointCloud {
    SurfaceTrimming(options: options.trimming).rayTargets(in: [cloud, surroundings])
  }

  /// The samples of a cloud, and the solved system that they determine. Throws and uses masks and
  /// support like `run`.
  func system(
    of cloud: PointCloud, _ reconstruction: Reconstruction, silhouettes: Silhouettes?,
    support: SupportPlane?, _ context: StageContext
  ) throws -> SurfaceSystem {
    let samples = try samples(
      of: cloud, reconstruction, silhouettes: silhouettes, support: support,
      context.part(from: 0, to: 0.15))
    let solution = try context.notes.step("poisson") {
      try poisson.solution(
        of: samples.cloud, spacing: samples.voxelSize, context.part(from: 0.15, to: 1))
    }
    return SurfaceSystem(samples: samples, solution: solution)
  }

  private var poisson: PoissonSurface {
    var poisson = PoissonSurface(options: options.poisson)
    poisson.options.maximumDepth = options.maximumDepth
    return poisson
  }

  /// The surface of a solved system. Throws like `run`.
  func mesh(
    of system: SurfaceSystem, observed: PointCloud, _ reconstruction: Reconstruction,
    silhouettes: Silhouettes?, _ context: StageContext
  ) throws -> Mesh {
    let (samples, notes) = (system.samples, context.notes)
    let (closed, cell) = try notes.step("poisson") {
      try poisson.surface(
        of: system.solution, samples.cloud, context.control.part(from: 0, to: 0.55))
    }
    var trimming = SurfaceTrimming(options: options.trimming)
    trimming.options.holeFilling.fillsLarge = samples.isObject && options.closesObject
    let trimmed = try trimming.run(
      // Where cells are larger than usual the surface is as far from its samples.
      closed, samples: samples.cloud, scene: observed,
      spacing: max(samples.voxelSize, cell / 2),
      support: samples.support, silhouettes: silhouettes, reconstruction,
      context.part(from: 0.55, to: 0.9))
    let mesh = try notes.step("cleaning") {
      try MeshCleaning(options: options.cleaning).run(
        trimmed, samples: samples.cloud, context.part(from: 0.9, to: 1))
    }
    notes.record("triangles", Double(mesh.triangles.count))
    return mesh
  }

  /// Selects the points of the object, or of the whole scene, and averages them by voxel.
  private func samples(
    of cloud: PointCloud, _ reconstruction: Reconstruction, silhouettes: Silhouettes?,
    support: SupportPlane?, _ context: StageContext
  ) throws -> SurfaceSamples {
    try check(cloud)
    let notes = context.notes
    let selection = try notes.step("selection") {
      try select(cloud, reconstruction, silhouettes, support, context.part(from: 0, to: 0.5))
    }
    let downsampling = VoxelDownsampling(options: options.downsampling)
    return try notes.step("samples") {
      var averaged = try downsampling.run(
        cloud, keeping: selection.isKept, context.part(from: 0.5, to: 0.7))
      var samples = SurfaceSamples(
        cloud: averaged.cloud, voxelSize: averaged.voxelSize, isObject: selection.isObject,
        support: selection.support)
      // A second reference to the cloud would cause a copy.
      averaged.cloud = PointCloud()
      try downsampling.removeOutliers(
        from: &samples.cloud, voxelSize: samples.voxelSize, context.control.part(from: 0.7, to: 1))
      notes.record("samples", Double(samples.cloud.count))
      return samples
    }
  }

  /// The box around what `run` would keep, in the frame of the cloud; from the sparse points if
  /// there is no cloud. Cheap. Nil without points.
  package func bounds(
    _ cloud: PointCloud?, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> (min: SIMD3<Float>, max: SIMD3<Float>)? {
    try ObjectIsolation(options: options.isolation).bounds(cloud, reconstruction, context)
  }

  /// The points that the surface is reconstructed from.
  private struct Selection {
    var isKept: [Bool]
    var isObject: Bool
    var support: SupportPlane?
  }

  /// Throws unless the cloud has enough finite points, with normals and footprints.
  private func check(_ cloud: PointCloud) throws {
    let finite = cloud.positions.count { $0.isFinite }
    guard finite >= options.minimumPoints, cloud.normals.count == cloud.count,
      cloud.footprints.count == cloud.count
    else {
      throw PipelineError.noSurface(
        reason: "the photos agree on \(finite) surface points only, at least "
          + "\(options.minimumPoints) are needed.")
    }
  }

  /// Selects the object's points by masks or by isolation, else all points of the scene.
  private func select(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ silhouettes: Silhouettes?,
    _ support: SupportPlane?, _ context: StageContext
  ) throws -> Selection {
    if options.isolatesObject, let silhouettes,
      silhouettes.share >= options.sufficientMaskShare
    {
      let isKept = try SceneTrimming(options: options.sceneTrimming)
        .run(cloud, reconstruction, context)
      context.notes.record("objectPoints", Double(isKept.count { $0 }))
      return Selection(
        isKept: isKept, isObject: true,
        support: support
          ?? SupportPlane(under: cloud.filtered(by: isKept), in: reconstruction.worldFrame))
    }
    if options.isolatesObject {
      let result = try ObjectIsolation(options: options.isolation)
        .run(cloud, reconstruction, context)
      if let failure = result.failure {
        context.notes.warn(
          "The object could not be separated from its surroundings: \(failure) "
            + "The whole scene is kept.")
      } else {
        let kept = result.isKept.filter { $0 }.count
        context.notes.record("objectPoints", Double(kept))
        context.notes.record("removedPoints", Double(cloud.count - kept))
        return Selection(isKept: result.isKept, isObject: true, support: result.support)
      }
    }
    let isKept = try SceneTrimming(options: options.sceneTrimming)
      .run(cloud, reconstruction, context)
    context.notes.record("removedPoints", Double(isKept.filter { !$0 }.count))
    return Selection(isKept: isKept, isObject: false, support: nil)
  }
}
