import Kernels
import SceneModel

/// The steps of the dense stage, each for the views that the plan lists. A step reads the results
/// of the previous one from the workspace and writes its own there.
struct DenseSteps {
  /// Views whose points are read at a time. Chosen: they are small beside the cloud.
  private static let viewsAtATime = 32

  private let views: DenseViews
  private let workspace: PatchWorkspace
  private let plan: DensePlan
  private let options: PointCloudGeneration.Options
  private let share: PointCloudGeneration.Share?
  private let masks: PatchMasks
  private let photos: SharedValues<PatchView>
  private let halves: SharedValues<PatchView>

  /// `share` identifies this job among several concurrent ones.
  init(
    _ views: DenseViews, _ workspace: PatchWorkspace, _ plan: DensePlan, _ masks: PatchMasks,
    _ options: PointCloudGeneration.Options, share: PointCloudGeneration.Share? = nil
  ) {
    self.views = views
    self.workspace = workspace
    self.plan = plan
    self.masks = masks
    self.options = options
    self.share = share
    let (count, pixels) = (views.views.count, max(1, views.largestPixelCount))
    photos = SharedValues(count: count, capacity: options.cacheBytes / 4 / (4 * pixels))
    halves = SharedValues(count: count, capacity: options.cacheBytes / 4 / pixels)
  }

  /// Runs all steps in order, up to the per-view clouds.
  func run(
    _ reconstruction: Reconstruction, _ images: ImageStore, _ context: StageContext
  ) throws {
    var parts = Progress(plan, context)
    try makeViews(reconstruction, images, parts.next(.view))
    try makeCoarsePatches(parts.next(.coarse))
    try filter(.coarse, options.coarseFilter, to: .coarseStates, parts.next(.coarseStates))
    try complete(.coarse, .coarseStates, to: .coarseCompleted, parts.next(.coarseCompleted))
    try refine(parts.next(.patches))
    try filter(.patches, options.filter, to: .states, parts.next(.states))
    try complete(.patches, .states, to: .completed, parts.next(.completed))
    try filter(.completed, options.filter, to: .completedStates, parts.next(.completedStates))
    try fuse(parts.next(.cloud))
  }

  /// Undistorts the photos at the stage's resolution.
  private func makeViews(
    _ reconstruction: Reconstruction, _ images: ImageStore, _ context: StageContext
  ) throws {
    try forEach(.view, context) { [self] index, _ in
      let view = try photos.value(index) {
        PatchView(
          try images.pinholeView(
            views.views[index].photo, of: reconstruction,
            maximumPixels: options.maximumPixelsPerView))
      }
      try workspace.write(view.rgbBytes, views.key(.view, index))
    }
  }

  /// Seeds, optimizes and expands patches within each view, at half the resolution.
  private func makeCoarsePatches(_ context: StageContext) throws {
    try forEach(.coarse, context) { [self] index, control in
      let view = views.views[index]
      guard let points = views.points[index] else {
        throw KernelError.invalidArgument("coarse patches need sparse points")
      }
      let half = try half(index)
      var map = PatchMapBuilder(view: half)
      do {
        try PatchStereo.reconstruct(
          &map, sources: try view.sources.map(self.half),
          seeds: points.compactMap { half.seed(at: $0) }, options: options.patches,
          control: control)
      } catch KernelError.degenerate {
        // A view without visible sparse points gets patches from other views only.
      }
      try masks.apply(to: &map, index)
      try map.withPatchBytes { try workspace.write($0, views.key(.coarse, index)) }
    }
  }

  /// Optimizes the patches at the view's full resolution, each against the sources in which its
  /// coarse patch is visible.
  private func refine(_ context: StageContext) throws {
    let maps = makeMaps()
    let coarseMap = { @Sendable [self] (index: Int) in try map(index, .coarseCompleted, in: maps) }
    try forEach(.patches, context) { [self] index, control in
      let sources = views.views[index].sources
      let coarse = try coarseMap(index)
      let states = try PatchStereo.filter(
        coarse, neighbors: try sources.map(coarseMap), options: options.coarseFilter,
        recordsVisibility: true, control: control.part(from: 0, to: 0.05))
      var map = PatchMapBuilder(view: try photo(index))
      try PatchStereo.refine(
        &map, from: coarse.filtered(states), sources: try sources.map(photo),
        options: options.patches, control: control.part(from: 0.05, to: 1))
      try masks.apply(to: &map, index)
      try map.withPatchBytes { try workspace.write($0, views.key(.patches, index)) }
    }
    recordPeaks(maps, context.notes)
  }

  /// Marks the patches that enough sources confirm.
  private func filter(
    _ patches: PatchWorkspace.Step, _ options: PatchStereo.FilterOptions,
    to states: PatchWorkspace.Step, _ context: StageContext
  ) throws {
    let maps = makeMaps()
    let map = { @Sendable [self] (index: Int) in try self.map(index, patches, in: maps) }
    try forEach(states, context) { [self] index, control in
      let accepted = try PatchStereo.filter(
        try map(index), neighbors: try views.views[index].sources.map(map), options: options,
        control: control)
      try accepted.withBytes { try workspace.write($0, views.key(states, index)) }
    }
    recordPeaks(maps, context.notes)
  }

  /// Expands patches across views and into holes, and re-estimates those at depth edges.
  private func complete(
    _ patches: PatchWorkspace.Step, _ states: PatchWorkspace.Step,
    to completed: PatchWorkspace.Step, _ context: StageContext
  ) throws {
    let maps = makeMaps()
    let map = { @Sendable [self] (index: Int) in
      try self.map(index, patches, states, in: maps)
    }
    try forEach(completed, context) { [self] index, control in
      let own = try map(index)
      guard options.completes else {
        return try own.withPatchBytes { try workspace.write($0, views.key(completed, index)) }
      }
      var result = try PatchStereo.complete(
        own, neighbors: try views.views[index].sources.map(map), options: options.patches,
        control: control)
      try masks.apply(to: &result, index)
      try result.withPatchBytes { try workspace.write($0, views.key(completed, index)) }
    }
    recordPeaks(maps, context.notes)
  }

  /// Fuses each view's accepted patches into its points of the cloud, without those outside the
  /// masks: photos without a mask may observe what the masks exclude.
  private func fuse(_ context: StageContext) throws {
    let maps = makeMaps()
    let silhouettes = plan[.cloud].isEmpty ? nil : try masks.silhouettes()
    let map = { @Sendable [self] (index: Int) in
      try self.map(index, .completed, .completedStates, in: maps)
    }
    try forEach(.cloud, context) { [self] index, control in
      let own = try map(index)
      var cloud = try PatchStereo.fuse(
        own, neighbors: try views.views[index].sources.map(map), options: options.filter,
        control: control)
      let count = cloud.count
      if let silhouettes {
        cloud.retain(try silhouettes.areInside(cloud.positions, KernelControl()))
      }
      try FusedView(
        cloud: cloud, acceptedPatches: own.acceptedCount, pointsOutsideMasks: count - cloud.count
      ).encoded.withUnsafeBytes { try workspace.write($0, views.key(.cloud, index)) }
    }
  }

  /// The cloud of the completed patches at half resolution, in view order.
  func coarseCloud(_ context: StageContext) throws -> PointCloud {
    let maps = makeMaps()
    let coarse = { @Sendable [self] (index: Int) in try map(index, .coarseCompleted, in: maps) }
    let accepted = try context.control.part(from: 0, to: 0.5).parallelMap(views.views.count) {
      [self] index in
      try PatchStereo.filter(
        try coarse(index), neighbors: try views.views[index].sources.map(coarse),
        options: options.coarseFilter, control: KernelControl())
    }
    let filtered = { @Sendable (index: Int) in try coarse(index).filtered(accepted[index]) }
    let clouds = try context.control.part(from: 0.5, to: 1).parallelMap(views.views.count) {
      [self] index in
      try PatchStereo.fuse(
        try filtered(index), neighbors: try views.views[index].sources.map(filtered),
        options: options.coarseFilter, control: KernelControl())
    }
    return clouds.reduce(into: PointCloud()) { $0.append($1) }
  }

  /// Concatenates the views' points in view order, thinned if there are too many.
  func cloud(_ context: StageContext) throws -> PointCloud {
    let thinning = CloudThinning(maximumPoints: options.maximumPoints)
    let assembly = CloudAssembly()
    var (points, accepted, outside) = (0, 0, 0)
    try readingAhead(views.views.count, by: Self.viewsAtATime, context.control) {
      [self] range, control in
      try control.parallelMap(range.count) { [self] in try fusedView(range.lowerBound + $0) }
    } use: { range, read in
      for view in read {
        points += view.cloud.count
        accepted += view.acceptedPatches
        outside += view.pointsOutsideMasks
      }
      guard !thinning.isNeeded(for: points) else { return _ = assembly.take() }
      try assembly.append(read.map(\.cloud), context.control)
      if range.lowerBound == 0 {
        assembly.reserveCapacity(
          times: Double(views.views.count) / Double(range.count), atMost: options.maximumPoints)
      }
    }
    if masks.areUsed { context.notes.record("pointsOutsideMasks", Double(outside)) }
    warnIfSparse(Double(accepted) / max(1, views.objectPixelCount), context.notes)
    guard thinning.isNeeded(for: points) else { return assembly.take() }
    let cloud = try thinning.run(parts: views.views.count, context) { try fusedView($0).cloud }
    context.notes.log(
      "Kept \(cloud.count) of \(points) points, as many as the memory allows.")
    return cloud
  }

  /// The points of a view as `fuse` wrote them.
  func fusedView(_ index: Int) throws -> FusedView {
    let key = views.key(.cloud, index)
    guard let view = workspace.bytes(key).flatMap({ FusedView(encoded: $0[...]) }) else {
      throw WorkspaceError.changed(file: workspace.url(key).path)
    }
    return view
  }

  /// Records the share of accepted pixels, and warns if the cloud is too sparse.
  private func warnIfSparse(_ ratio: Double, _ notes: StageNotes) {
    notes.record("acceptedPixelRatio", ratio)
    guard ratio < options.sparseRatio else { return }
    notes.warn(
      "Only \((1000 * ratio).rounded() / 10) % of the photos' area could be reconstructed, so the "
        + "model has large holes: take more photos, from positions further apart.")
  }
}

extension DenseSteps {
  /// Calls `body` for each view that lacks the step's file.
  private func forEach(
    _ step: PatchWorkspace.Step, _ context: StageContext,
    _ body: @escaping @Sendable (Int, KernelControl) throws -> Void
  ) throws {
    let indices = inOrderOfWork(plan[step])
    try context.notes.step(step.rawValue) {
      _ = try context.control.parallelUnits(indices.count) { [self] unit, control in
        // A concurrent job may have written it since planning.
        if share != nil, workspace.contains(views.key(step, indices[unit])) { return }
        try body(indices[unit], control)
      }
    }
  }

  /// With several jobs, each starts with its own share and then helps the others, from the end.
  private func inOrderOfWork(_ indices: [Int]) -> [Int] {
    guard let share else { return indices }
    let own = indices.filter { share.contains($0) }
    return own + indices.reversed().filter { !share.contains($0) }
  }

  /// View `index` at the stage's resolution, shared between threads.
  private func photo(_ index: Int) throws -> PatchView {
    try photos.value(index) {
      let (view, key) = (views.views[index], views.key(.view, index))
      return try PatchView(
        photo: view.photo, camera: view.camera, cameraFromWorld: view.cameraFromWorld,
        width: key.width, height: key.height
      ) { try read(key, into: $0) }
    }
  }

  /// View `index` at half the stage's resolution.
  private func half(_ index: Int) throws -> PatchView {
    try halves.value(index) { try photo(index).halved() }
  }

  /// A cache of patch maps by view, bounded by the memory budget.
  private func makeMaps() -> SharedValues<PatchMap> {
    SharedValues(
      count: views.views.count,
      capacity: options.cacheBytes / 4 * 3
        / max(1, PatchMap.bytesPerPixel * views.largestPixelCount))
  }

  /// A view's patches as written by step `patches`, with the acceptance states of step `states`.
  private func map(
    _ index: Int, _ patches: PatchWorkspace.Step, _ states: PatchWorkspace.Step? = nil,
    in maps: SharedValues<PatchMap>
  ) throws -> PatchMap {
    try maps.value(index) {
      let view = patches.isCoarse ? try half(index) : try photo(index)
      let accepted = try states.map { states in
        try PatchStates(view: view) { try read(views.key(states, index), into: $0) }
      }
      return try PatchMap(view: view, states: accepted) {
        try read(views.key(patches, index), into: $0)
      }
    }
  }

  /// Records the peak numbers of maps and views in memory.
  private func recordPeaks(_ maps: SharedValues<PatchMap>, _ notes: StageNotes) {
    let before = notes.counts["peakMaps"] ?? 0
    notes.record("peakMaps", max(before, Double(maps.peakCount)))
    notes.record("peakViews", Double(photos.peakCount))
  }

  /// Reads a file of this run; throws if it was changed or deleted.
  private func read(
    _ key: PatchWorkspace.Key, into buffer: UnsafeMutableRawBufferPointer
  ) throws {
    guard workspace.read(key, into: buffer) else {
      throw WorkspaceError.changed(file: workspace.url(key).path)
    }
  }

  /// Divides the stage's progress among the steps in proportion to their expected work.
  private struct Progress {
    private let context: StageContext
    private let shares: [PatchWorkspace.Step: Double]
    private var done = 0.0

    /// Relative cost of each step per view. Chosen: for progress only.
    private static let costs: [(PatchWorkspace.Step, Double)] = [
      (.view, 0.03), (.coarse, 0.13), (.coarseStates, 0.02), (.coarseCompleted, 0.06),
      (.patches, 0.35), (.states, 0.08), (.completed, 0.17), (.completedStates, 0.08),
      (.cloud, 0.08),
    ]

    init(_ plan: DensePlan, _ context: StageContext) {
      self.context = context
      let work = Self.costs.map { ($0, $1 * Double(plan[$0].count)) }
      let sum = work.reduce(0) { $0 + $1.1 }
      shares = Dictionary(uniqueKeysWithValues: work.map { ($0, sum > 0 ? $1 / sum : 0) })
    }

    mutating func next(_ step: PatchWorkspace.Step) -> StageContext {
      let start = done
      done = min(1, done + (shares[step] ?? 0))
      return context.part(from: start, to: done)
    }
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
