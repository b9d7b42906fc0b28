import Foundation
import Kernels
import SceneModel

/// Patch-based multi-view stereo: seeds patches from the sparse points, optimizes and expands them
/// over every view, filters them by visibility consistency and fuses them into one oriented,
/// colored cloud.
///
/// Y. Furukawa, J. Ponce: Accurate, dense, and robust multiview stereopsis, PAMI 2010. The schedule
/// differs from the paper: one patch grid per view, coarse to fine. Each step processes one view
/// and reads the results of the previous step for it and its sources from files. Memory is
/// therefore bounded by one view and its sources per thread, independent of the number of photos,
/// and an interrupted run can be resumed.
package struct PointCloudGeneration {
  package var options: Options
  /// Parent of the temporary folder.
  var temporaryParent = ScratchFolder.parent

  package init(options: Options = Options()) {
    self.options = options
  }

  /// Computes the fused cloud, in the reconstruction's frame.
  ///
  /// `folder` receives the intermediate files of each view and is kept, so that a later run can
  /// resume from it; without one, a temporary folder is used and removed. Throws
  /// `PipelineError.noSurface` if no surface is found, and `WorkspaceError` if the folder can't be
  /// used.
  package func run(
    _ reconstruction: Reconstruction, images: ImageStore, folder: URL? = nil,
    _ context: StageContext
  ) throws -> PointCloud {
    let start = context.part(from: 0, to: 0).control
    let views = try DenseViews(reconstruction, images: images, options: options, start)
    return try run(views, reconstruction, images: images, folder: folder, context)
  }

  /// The same with known views, which are selected again if they lack sparse points that missing
  /// files are made from.
  func run(
    _ views: DenseViews, _ reconstruction: Reconstruction, images: ImageStore, folder: URL?,
    _ context: StageContext
  ) throws -> PointCloud {
    let start = context.part(from: 0, to: 0).control
    let workspace = try PatchWorkspace(folder: folder, temporaryParent: temporaryParent)
    let plan = try DensePlan(.cloud, views, workspace, start)
    guard plan.isFeasible(for: views) else {
      return try run(reconstruction, images: images, folder: workspace.folder, context)
    }
    try workspace.checkSpace(plan.byteCount(views))
    recordReuse(views.views.count - plan[.patches].count, views, context.notes)
    let steps = DenseSteps(
      views, workspace, plan, masks(of: views, reconstruction, images), options)
    try steps.run(reconstruction, images, context.part(from: 0, to: 0.98))
    let cloud = try steps.cloud(context.part(from: 0.98, to: 1))
    guard cloud.count > 0 else {
      throw PipelineError.noSurface(
        reason: "no surface patch is consistent in three or more photos.")
    }
    context.notes.record("points", Double(cloud.count))
    return cloud
  }

  /// The points of each view in `folder`, which are read when they are used; those of a file that
  /// is missing or damaged are computed again, if necessary from the views of `withPoints`.
  func fusedViews(
    of views: DenseViews, _ reconstruction: Reconstruction, images: ImageStore, folder: URL,
    _ control: KernelControl, withPoints: @escaping () throws -> DenseViews
  ) throws -> FusedViews {
    let workspace = try PatchWorkspace(folder: folder)
    let masks = masks(of: views, reconstruction, images)
    let steps = { [options] (views: DenseViews, plan: DensePlan) in
      DenseSteps(views, workspace, plan, masks, options)
    }
    let complete = steps(views, try DensePlan(.cloud, of: [], views, workspace, control))
    return FusedViews(count: views.views.count) { view in
      if let found = try? complete.fusedView(view) { return found.cloud }
      let plan = try DensePlan(.cloud, of: [view], views, workspace, control)
      let missing = steps(plan.isFeasible(for: views) ? views : try withPoints(), plan)
      try missing.run(reconstruction, images, StageContext(control: control))
      return try missing.fusedView(view).cloud
    }
  }

  /// Computes the patches of a share of the views, with what they require from other views, and
  /// leaves all results in `folder`.
  ///
  /// This is two thirds of the work: once all shares are finished, by concurrent processes or in
  /// sequence, `run` completes and fuses them. Concurrent jobs divide the coarse patches of all
  /// views among themselves.
  package func run(
    _ share: Share, of reconstruction: Reconstruction, images: ImageStore, folder: URL,
    _ context: StageContext
  ) throws {
    guard share.count > 0, (0..<share.count).contains(share.index) else {
      throw KernelError.invalidArgument("there is no share \(share.index) of \(share.count)")
    }
    let start = context.part(from: 0, to: 0).control
    let views = try DenseViews(reconstruction, images: images, options: options, start)
    let workspace = try PatchWorkspace(folder: folder)
    let own = views.indices.filter(share.contains)
    let plan = try DensePlan(
      .patches, of: own, views, workspace, start)
    try workspace.checkSpace(plan.byteCount(views))
    recordReuse(own.count - plan[.patches].count, views, context.notes)
    try DenseSteps(
      views, workspace, plan, masks(of: views, reconstruction, images), options, share: share
    ).run(reconstruction, images, context)
  }

  /// Computes the results of a step for a block of the views, with whatever they require and is
  /// missing, and leaves all in `folder`. Returns false, with nothing computed, if that takes
  /// sparse points that the views lack.
  func make(
    _ step: PatchWorkspace.Step, _ block: Block, of views: DenseViews,
    _ reconstruction: Reconstruction, images: ImageStore, folder: URL, _ context: StageContext
  ) throws -> Bool {
    let start = context.part(from: 0, to: 0).control
    let workspace = try PatchWorkspace(folder: folder)
    let own = Array(views.indices)[block.range(of: views.views.count)]
    let plan = try DensePlan(
      step, of: Array(own), views, workspace, start)
    guard plan.isFeasible(for: views) else { return false }
    try workspace.checkSpace(plan.byteCount(views))
    try DenseSteps(views, workspace, plan, masks(of: views, reconstruction, images), options)
      .run(reconstruction, images, context)
    return true
  }

  /// Computes a cloud from the patches at half the resolution of the views, in the reconstruction's
  /// frame, at a fifth of the cost. Throws like `run`.
  func coarseCloud(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> PointCloud {
    let start = context.part(from: 0, to: 0).control
    let views = try DenseViews(reconstruction, images: images, options: options, start)
    let workspace = try PatchWorkspace(folder: nil, temporaryParent: temporaryParent)
    let plan = try DensePlan(
      .coarseCompleted, views, workspace, start)
    try workspace.checkSpace(plan.byteCount(views))
    let steps = DenseSteps(
      views, workspace, plan, masks(of: views, reconstruction, images), options)
    try steps.run(reconstruction, images, context.part(from: 0, to: 0.9))
    let cloud = try steps.coarseCloud(context.part(from: 0.9, to: 1))
    guard cloud.count > 0 else {
      throw PipelineError.noSurface(
        reason: "no surface patch is consistent in three or more photos.")
    }
    return cloud
  }

  private func masks(
    of views: DenseViews, _ reconstruction: Reconstruction, _ images: ImageStore
  ) -> PatchMasks {
    PatchMasks(views, reconstruction, images, maximumPixels: options.maximumPixelsPerView)
  }

  /// Records view counts, and logs how many views are reused.
  private func recordReuse(_ reused: Int, _ views: DenseViews, _ notes: StageNotes) {
    let count = views.views.count
    notes.record("views", Double(count))
    notes.record("viewMegapixels", Double(views.pixelCount) / 1e6)
    notes.record("reusedViews", Double(reused))
    if reused > 0 {
      notes.log("Reused the patches of \(reused) of \(count) views from an earlier run.")
    }
  }
}
