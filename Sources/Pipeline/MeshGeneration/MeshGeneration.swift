import Foundation
import Kernels
import SceneModel

/// Makes the surface of the object, or of the whole scene, from the dense cloud.
///
/// Isolate, average, Poisson, trim and close, clean: one step a file.
package struct MeshGeneration {
  package struct Options: Hashable, Codable, Sendable {
    /// Keep the object that the photos look at and remove its support and background.
    package var isolatesObject = true
    /// Close what no photo shows of an isolated object; otherwise large gaps stay open.
    package var closesObject = true
    /// Levels of the surface's octree at most; 9 resolves 1/460, 10 1/930 of the object's size.
    package var maximumDepth = 9
    /// Share of the photos with masks from which on these tell the object from its surroundings.
    package var sufficientMaskShare = 0.5

    package init() {}

    /// For a cloud from views of so many pixels: beyond 0.5 MP twice as fine for four times as many.
    package init(viewPixels: Int) {
      let finer = log2(Double(max(500_000, viewPixels)) / 500_000) / 2
      maximumDepth = min(12, 9 + Int(finer.rounded()))
    }
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The surface with normals and colours, in the frame of the cloud. Where most photos have masks, the
  /// object is what `silhouettes` keep.
  ///
  /// Throws `PipelineError.noSurface` where the cloud does not determine one.
  package func run(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, silhouettes: Silhouettes? = nil,
    _ context: StageContext
  ) throws -> Mesh {
    try check(cloud)
    let selection = try select(
      cloud, reconstruction, silhouettes, context.part(from: 0, to: 0.05))
    var averaged = try CloudAveraging().run(
      cloud.filtered(by: selection.isKept), context.part(from: 0.05, to: 0.07))
    averaged.cloud = try averaged.withoutStrays(context.control.part(from: 0.07, to: 0.1))
    context.notes.count("samples", Double(averaged.cloud.count))
    var poisson = PoissonSurface()
    poisson.options.maximumDepth = options.maximumDepth
    let (closed, cell) = try poisson.run(
      averaged.cloud, spacing: averaged.voxelSize, context.part(from: 0.1, to: 0.85))
    var trimming = SurfaceTrimming()
    trimming.options.closing.closesLarge = selection.isObject && options.closesObject
    let trimmed = try trimming.run(
      // Where cells are larger than usual the surface is as far from its samples.
      closed, samples: averaged.cloud, scene: cloud, spacing: max(averaged.voxelSize, cell / 2),
      support: selection.support, silhouettes: silhouettes, reconstruction,
      context.part(from: 0.85, to: 0.96))
    let mesh = try MeshCleaning().run(
      trimmed, samples: averaged.cloud, context.part(from: 0.96, to: 1))
    context.notes.count("triangles", Double(mesh.triangles.count))
    return mesh
  }

  /// The box around what `run` keeps, from the sparse points where there is no cloud; cheap.
  package func bounds(
    _ cloud: PointCloud?, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> (min: SIMD3<Float>, max: SIMD3<Float>)? {
    try ObjectIsolation().bounds(cloud, reconstruction, context)
  }

  /// The points that the surface is made of.
  private struct Selection {
    var isKept: [Bool]
    var isObject: Bool
    var support: StandingPlane?
  }

  private func check(_ cloud: PointCloud) throws {
    let finite = cloud.positions.reduce(0) {
      $1.x.isFinite && $1.y.isFinite && $1.z.isFinite ? $0 + 1 : $0
    }
    guard finite >= 100, cloud.normals.count == cloud.count,
      cloud.footprints.count == cloud.count
    else {
      throw PipelineError.noSurface(
        reason: "the photos agree on \(finite) surface points only, at least 100 are needed.")
    }
  }

  private func select(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ silhouettes: Silhouettes?,
    _ context: StageContext
  ) throws -> Selection {
    if let silhouettes, silhouettes.share >= options.sufficientMaskShare {
      let isKept = try SceneTrimming().run(cloud, reconstruction, context)
      context.notes.count("objectPoints", Double(isKept.count { $0 }))
      return Selection(
        isKept: isKept, isObject: true,
        support: StandingPlane(
          under: cloud.filtered(by: isKept), up: reconstruction.worldFrame.up))
    }
    if options.isolatesObject {
      let result = try ObjectIsolation().run(cloud, reconstruction, context)
      if let failure = result.failure {
        context.notes.warn(
          "The object could not be told from its surroundings: \(failure) The whole scene is kept.")
      } else {
        let kept = result.isKept.filter { $0 }.count
        context.notes.count("objectPoints", Double(kept))
        context.notes.count("removedPoints", Double(cloud.count - kept))
        return Selection(isKept: result.isKept, isObject: true, support: result.support)
      }
    }
    let isKept = try SceneTrimming().run(cloud, reconstruction, context)
    context.notes.count("removedPoints", Double(isKept.filter { !$0 }.count))
    return Selection(isKept: isKept, isObject: false, support: nil)
  }
}
