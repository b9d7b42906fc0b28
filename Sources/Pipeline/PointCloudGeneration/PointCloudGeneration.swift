import Foundation
import Kernels
import SceneModel

/// Patch multi-view stereo: seeds patches from the sparse points, optimises and expands them over
/// every view, filters them by visibility and fuses them to one oriented, coloured cloud.
///
/// Y. Furukawa, J. Ponce: Accurate, dense, and robust multiview stereopsis, PAMI 2010. The schedule
/// is our own: a grid of patches a view, coarse to fine. Each step works on one view and reads what
/// the step before made of it and of its sources, from files: memory is bounded by a view and its
/// sources a thread, whatever the number of photos, and a run goes on where another ended.
package struct PointCloudGeneration {
  package struct Options: Hashable, Codable, Sendable {
    /// Pixels of a view at the finest level.
    package var maximumPixelsPerView = 1_000_000
    package var patches = PatchStereo.Options()
    package var filter = PatchStereo.FilterOptions()
    /// Of the patches at half the resolution, where smaller islands may grow.
    package var coarseFilter = PatchStereo.FilterOptions(minimumIsland: 10)
    /// Whether patches grow into what the filter rejected, and are made anew at edges.
    package var completes = true
    /// Share of the photos' pixels below which the cloud is called sparse in a warning.
    package var sparseRatio = 0.05
    /// Bytes of views and patches that are kept in memory although nobody works on them.
    package var keptBytes = 512 << 20

    package init(maximumPixelsPerView: Int = 1_000_000) {
      self.maximumPixelsPerView = maximumPixelsPerView
    }
  }

  /// Every `count`-th view, from `index` on: what one of several jobs does.
  package struct Share: Hashable, Sendable {
    package var index: Int
    package var count: Int

    /// `index` is 0…`count` − 1.
    package init(index: Int, of count: Int) {
      self.index = index
      self.count = count
    }

    func contains(_ position: Int) -> Bool { position % count == index }
  }

  package var options: Options
  /// Where the temporary folder is made.
  var temporaryParent = PatchWorkspace.temporaryParent

  package init(options: Options = Options()) {
    self.options = options
  }

  /// Makes the cloud. `folder` holds the files of each view and stays, for a later run to go on with;
  /// without one they are in a temporary folder that goes away.
  package func run(
    _ reconstruction: Reconstruction, images: ImageStore, folder: URL? = nil,
    _ context: StageContext
  ) throws -> PointCloud {
    let views = try DenseViews(reconstruction, images: images, options: options)
    let workspace = try PatchWorkspace(folder: folder, temporaryParent: temporaryParent)
    defer { workspace.close() }
    let plan = try DensePlan(.cloud, views, workspace, context.part(from: 0, to: 0).control)
    try workspace.checkSpace(plan.byteCount(views))
    tellReuse(views.views.count - plan[.patches].count, views, context.notes)
    let steps = DenseSteps(
      views, workspace, plan, masks(of: views, reconstruction, images), options)
    try steps.run(reconstruction, images, context.part(from: 0, to: 0.98))
    let cloud = try insideMasks(
      steps.cloud(context.part(from: 0.98, to: 0.99)), reconstruction, images,
      context.part(from: 0.99, to: 1))
    guard cloud.count > 0 else {
      throw PipelineError.noSurface(
        reason: "no patch of surface looks alike in three photos or more.")
    }
    context.notes.count("points", Double(cloud.count))
    return cloud
  }

  /// Makes the patches of a share of the views, with what they need of other views, and leaves all in
  /// `folder`. That is two thirds of the work: once all shares are made, by processes at the same
  /// time or one after the other, `run` completes and fuses them. Jobs at the same time share the
  /// coarse patches of all views between them.
  package func run(
    _ share: Share, of reconstruction: Reconstruction, images: ImageStore, folder: URL,
    _ context: StageContext
  ) throws {
    guard share.count > 0, (0..<share.count).contains(share.index) else {
      throw KernelError.invalidArgument("there is no share \(share.index) of \(share.count)")
    }
    let views = try DenseViews(reconstruction, images: images, options: options)
    let workspace = try PatchWorkspace(folder: folder)
    let own = views.indices.filter(share.contains)
    let plan = try DensePlan(
      .patches, of: own, views, workspace, context.part(from: 0, to: 0).control)
    try workspace.checkSpace(plan.byteCount(views))
    tellReuse(own.count - plan[.patches].count, views, context.notes)
    try DenseSteps(
      views, workspace, plan, masks(of: views, reconstruction, images), options, share: share
    ).run(reconstruction, images, context)
  }

  private func masks(
    of views: DenseViews, _ reconstruction: Reconstruction, _ images: ImageStore
  ) -> PatchMasks {
    PatchMasks(views, reconstruction, images, maximumPixels: options.maximumPixelsPerView)
  }

  /// Photos without a mask may have seen what those with one leave out.
  private func insideMasks(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ images: ImageStore,
    _ context: StageContext
  ) throws -> PointCloud {
    guard let silhouettes = try Silhouettes(reconstruction, images: images) else { return cloud }
    let result = cloud.filtered(
      by: try silhouettes.areInside(cloud.positions, context.control))
    context.notes.count("pointsOutsideMasks", Double(cloud.count - result.count))
    return result
  }

  private func tellReuse(_ reused: Int, _ views: DenseViews, _ notes: StageNotes) {
    let count = views.views.count
    notes.count("views", Double(count))
    notes.count("viewMegapixels", Double(views.pixelCount) / 1e6)
    notes.count("reusedViews", Double(reused))
    if reused > 0 {
      notes.tell("The patches of \(reused) of \(count) views were there from an earlier run.")
    }
  }
}
