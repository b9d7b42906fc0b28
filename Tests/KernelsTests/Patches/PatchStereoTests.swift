import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// Patches of rendered views with known depth.
@Suite struct PatchStereoTests {
  static let scene = RaycastScene()

  /// The maps of all views, each with all others as sources.
  static func maps(
    _ scene: RaycastScene, _ options: PatchStereo.Options = PatchStereo.Options(),
    noise: Float? = nil, isHalved: Bool = false, seeds perturb: (PatchSeed) -> PatchSeed = { $0 },
    control: KernelControl = KernelControl()
  ) throws -> [PatchMap] {
    let fullViews = scene.views.map { PatchView($0, noise: noise) }
    let views = isHalved ? fullViews.map { $0.halved() } : fullViews
    return try views.indices.map { index in
      var map = PatchMapBuilder(view: views[index])
      let seeds = scene.reconstruction.points.compactMap { point -> PatchSeed? in
        guard point.track.contains(where: { $0.photo.index == index }) else { return nil }
        let seen = views[index].cameraFromWorld * point.position
        let pixel = views[index].camera.project(seen)
        return perturb(
          PatchSeed(pixel: SIMD2<Float>(pixel), inverseDepth: Float(1 / seen.z)))
      }
      try PatchStereo.reconstruct(
        &map, sources: views.indices.filter { $0 != index }.map { views[$0] }, seeds: seeds,
        options: options, control: control)
      return map.finished()
    }
  }

  /// Median relative depth error of good patches in the center of a view, and their share.
  static func depthError(
    _ map: PatchMap, _ scene: RaycastScene, view: Int
  ) -> (median: Double, share: Double) {
    var errors: [Double] = []
    var count = 0
    for y in stride(from: 30, to: 110, by: 2) {
      for x in stride(from: 20, to: 140, by: 2) {
        guard let truth = scene.depth(view, x, y) else { continue }
        count += 1
        guard map[x, y].cost < 0.4 else { continue }
        errors.append(abs(1 / Double(map[x, y].inverseDepth) / truth - 1))
      }
    }
    return (
      errors.sorted().dropFirst(errors.count / 2).first ?? .infinity,
      Double(errors.count) / Double(count)
    )
  }

  @Test func depthsAreAccurate() throws {
    let maps = try Self.maps(Self.scene)
    for view in maps.indices {
      let error = Self.depthError(maps[view], Self.scene, view: view)
      #expect(error.median < 0.002)
      #expect(error.share > 0.7)
    }
  }

  @Test func gaussNewtonConvergesFromPerturbedSeeds() throws {
    // Depths are off by up to 2 % and there are no random planes: only Gauss–Newton can correct
    // them.
    var options = PatchStereo.Options()
    options.perturbations = 0
    var random = SeededGenerator(seed: 5)
    let perturb = { (seed: PatchSeed) -> PatchSeed in
      let factor = Float(1 + 0.04 * (random.uniform() - 0.5))
      return PatchSeed(pixel: seed.pixel, inverseDepth: seed.inverseDepth * factor)
    }
    let maps = try Self.maps(Self.scene, options, seeds: perturb)
    options.refinementSteps = 0
    random = SeededGenerator(seed: 5)
    let unrefined = try Self.maps(Self.scene, options, seeds: perturb)
    let error = Self.depthError(maps[2], Self.scene, view: 2)
    #expect(error.median < 0.003)
    #expect(error.median < 0.7 * Self.depthError(unrefined[2], Self.scene, view: 2).median)
  }

  @Test(arguments: Instructions.allCases.filter(\.isSupported))
  func instructionSetsAgree(_ instructions: Instructions) throws {
    var options = PatchStereo.Options()
    // In untextured areas rounding decides.
    options.instructions = .portable
    let expected = try Self.maps(Self.scene, options, noise: 1)[2]
    options.instructions = instructions
    let map = try Self.maps(Self.scene, options, noise: 1)[2]
    var (close, count) = (0, 0)
    for y in 20..<110 {
      for x in 20..<140 where expected[x, y].cost < 0.3 {
        count += 1
        let ratio = map[x, y].inverseDepth / expected[x, y].inverseDepth
        close += abs(ratio - 1) < 0.002 ? 1 : 0
      }
    }
    #expect(count > 1000)
    #expect(Double(close) > 0.97 * Double(count))
  }

  /// Filtered patches of all views at half the resolution, with visibility.
  static func coarseMaps(_ scene: RaycastScene) throws -> [PatchMap] {
    let maps = try maps(scene, isHalved: true)
    return try maps.indices.map { index in
      maps[index].filtered(
        try PatchStereo.filter(
          maps[index], neighbors: others(maps, index), options: PatchStereo.FilterOptions(),
          recordsVisibility: true, control: KernelControl()))
    }
  }

  @Test func refinedPatchesAreAccurate() throws {
    let coarse = try Self.coarseMaps(Self.scene)
    let views = Self.scene.views.map { PatchView($0) }
    for index in views.indices {
      var map = PatchMapBuilder(view: views[index])
      try PatchStereo.refine(
        &map, from: coarse[index], sources: views.indices.filter { $0 != index }.map { views[$0] },
        options: PatchStereo.Options(), control: KernelControl())
      let error = Self.depthError(map.finished(), Self.scene, view: index)
      #expect(error.median < 0.002)
      #expect(error.share > 0.7)
    }
  }

  @Test func refinementRequiresHalfResolution() throws {
    let views = Self.scene.views.map { PatchView($0) }
    let whole = Self.empty(views[0])
    let states = try PatchStereo.filter(
      whole, neighbors: [Self.empty(views[1])], options: PatchStereo.FilterOptions(),
      recordsVisibility: true, control: KernelControl())
    #expect(throws: KernelError.self) {
      var map = PatchMapBuilder(view: views[0])
      try PatchStereo.refine(
        &map, from: whole.filtered(states), sources: [views[1]], options: PatchStereo.Options(),
        control: KernelControl())
    }
  }

  @Test func viewWithoutPatchesIsFilledFromOthers() throws {
    let maps = try Self.filtered(Self.maps(Self.scene))
    let empty = Self.empty(maps[2].view)
    let completed = try PatchStereo.complete(
      empty, neighbors: Self.others(maps, 2), options: PatchStereo.Options(),
      control: KernelControl()
    ).finished()
    let error = Self.depthError(completed, Self.scene, view: 2)
    #expect(error.median < 0.002)
    #expect(error.share > 0.6)
    // Without other views' patches there are no candidates.
    let alone = try PatchStereo.complete(
      empty, neighbors: Self.others(maps, 2).map { Self.empty($0.view) },
      options: PatchStereo.Options(), control: KernelControl()
    ).finished()
    #expect(Self.depthError(alone, Self.scene, view: 2).share == 0)
  }

  /// The filtered patches of the third view, and the completed ones.
  static func completed() throws -> (map: PatchMap, completed: PatchMap) {
    let maps = try filtered(maps(scene))
    let completed = try PatchStereo.complete(
      maps[2], neighbors: others(maps, 2), options: PatchStereo.Options(),
      control: KernelControl()
    ).finished()
    return (maps[2], completed)
  }

  @Test func completionBarelyMovesAcceptedPatches() throws {
    let (map, completed) = try Self.completed()
    var (accepted, moved, rejected, changed) = (0, 0, 0, 0)
    for y in 0..<120 {
      for x in 0..<160 {
        let (before, after) = (map[x, y], completed[x, y])
        if map.isAccepted(x, y) {
          accepted += 1
          moved += abs(after.inverseDepth / before.inverseDepth - 1) > 0.005 ? 1 : 0
        } else {
          rejected += 1
          changed += after == before ? 0 : 1
        }
      }
    }
    #expect(accepted > 5000 && moved < accepted / 20)
    #expect(changed > 0 && changed < rejected)
  }

  /// Next to the outline of the ball, where a patch sees both the ball and the floor behind it.
  @Test func completionSharpensDepthEdges() throws {
    let (map, completed) = try Self.completed()
    let edges = Self.edgePixels(Self.scene, view: 2)
    #expect(edges.count > 200)
    let right = { (map: PatchMap) in
      edges.filter { abs(1 / Double(map[$0.x, $0.y].inverseDepth) / $0.depth - 1) < 0.01 }.count
    }
    let (before, after) = (right(map), right(completed))
    #expect(after > before + edges.count / 50)
  }

  /// Pixels within two of a depth discontinuity.
  static func edgePixels(
    _ scene: RaycastScene, view: Int
  ) -> [(x: Int, y: Int, depth: Double)] {
    var pixels: [(x: Int, y: Int, depth: Double)] = []
    for y in 5..<115 {
      for x in 5..<155 {
        guard let depth = scene.depth(view, x, y) else { continue }
        let around = [(-2, 0), (2, 0), (0, -2), (0, 2)].compactMap {
          scene.depth(view, x + $0.0, y + $0.1)
        }
        if around.contains(where: { abs($0 / depth - 1) > 0.1 }) { pixels.append((x, y, depth)) }
      }
    }
    return pixels
  }

  @Test func halvedViewsHaveHalfTheNoise() throws {
    let view = PatchView(Self.scene.views[0], noise: 3)
    let half = view.halved()
    #expect(half.width == 80 && half.height == 60 && half.noise == 1.5)
    #expect(half.camera.focalLength == view.camera.focalLength / 2)
    // The same ray passes through the corner of a pixel and of the four that it averages.
    #expect(half.camera.unproject([20, 10]) == view.camera.unproject([40, 20]))
  }

  @Test func pointsLieOnTheSurface() throws {
    let maps = try Self.maps(Self.scene)
    let cloud = try Self.fused(maps)
    #expect(cloud.count > 3000)
    let distances = cloud.positions.map { Self.scene.distance(to: SIMD3<Double>($0)) }.sorted()
    #expect(distances[cloud.count / 2] < 0.008)
    #expect(distances[cloud.count * 95 / 100] < 0.04)
    var angles: [Double] = []
    for index in 0..<cloud.count {
      // A point has at least two photos, in order.
      #expect(cloud.visiblePhotos(of: index).count >= 2)
      #expect(cloud.visiblePhotos(of: index).elementsEqual(cloud.visiblePhotos(of: index).sorted()))
      let (p, n) = (SIMD3<Double>(cloud.positions[index]), SIMD3<Double>(cloud.normals[index]))
      let truth: SIMD3<Double> = p.y < -1.1 ? [0, 1, 0] : p.normalized
      angles.append(acos(min(1, n.dot(truth))) * 180 / .pi)
      let photo = Int(cloud.visiblePhotos(of: index).first ?? 0)
      #expect((Self.scene.views[photo].cameraFromWorld.center - p).dot(n) > 0)
    }
    #expect(angles.sorted()[angles.count / 2] < 10)
  }

  @Test func floatersAreRemoved() throws {
    var maps = try Self.maps(Self.scene)
    // A confident patch of 20 × 20 pixels halfway to the ball, in one view only and in two.
    let region = (60..<80, 50..<70)
    for view in [2, 3] {
      var changed = PatchMapBuilder(copying: maps[view])
      for y in region.1 {
        for x in region.0 {
          changed[x, y] = Patch(
            inverseDepth: 2 * maps[view][x, y].inverseDepth, gradient: .zero, cost: 0.01)
        }
      }
      maps[view] = changed.finished()
    }
    maps = try Self.filtered(maps)
    let left = region.1.flatMap { y in region.0.map { ($0, y) } }
      .filter { maps[2].isAccepted($0.0, $0.1) }
    #expect(left.isEmpty)
    #expect(maps[1].acceptedCount > 2000)
  }

  @Test func untexturedScenesHaveNoPoints() throws {
    var options = RaycastScene.Options()
    options.isUniform = true
    let scene = RaycastScene(options)
    let cloud = try Self.fused(Self.maps(scene))
    #expect(cloud.count < 200)  // Only the outline of the ball against the floor has texture.
  }

  @Test func cancellationStops() throws {
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > 0.1 { flag.cancel() } }
    #expect(throws: CancellationError.self) { try Self.maps(Self.scene, control: control) }
  }

  @Test func aViewWithoutSeedsIsDegenerate() throws {
    let views = Self.scene.views.map { PatchView($0) }
    #expect(throws: KernelError.self) {
      var map = PatchMapBuilder(view: views[0])
      try PatchStereo.reconstruct(
        &map, sources: [views[1]], seeds: [], options: PatchStereo.Options(),
        control: KernelControl())
    }
    let broken = [PatchSeed(pixel: [.nan, 3], inverseDepth: .infinity)]
    #expect(throws: KernelError.self) {
      var map = PatchMapBuilder(view: views[0])
      try PatchStereo.reconstruct(
        &map, sources: [views[1]], seeds: broken, options: PatchStereo.Options(),
        control: KernelControl())
    }
  }

  static func others(_ maps: [PatchMap], _ index: Int) -> [PatchMap] {
    maps.indices.filter { $0 != index }.map { maps[$0] }
  }

  /// A filtered map without patches.
  static func empty(_ view: PatchView) -> PatchMap {
    PatchMapBuilder(view: view).finished().filtered(
      PatchStates(view: view) { $0.initializeMemory(as: UInt8.self, repeating: 0) })
  }

  static func filtered(
    _ maps: [PatchMap], control: KernelControl = KernelControl()
  ) throws -> [PatchMap] {
    try maps.indices.map { index in
      maps[index].filtered(
        try PatchStereo.filter(
          maps[index], neighbors: others(maps, index), options: PatchStereo.FilterOptions(),
          control: control))
    }
  }

  static func fused(
    _ maps: [PatchMap], control: KernelControl = KernelControl()
  ) throws -> PointCloud {
    let maps = try filtered(maps, control: control)
    return try maps.indices.reduce(into: PointCloud()) {
      $0.append(
        try PatchStereo.fuse(
          maps[$1], neighbors: others(maps, $1), options: PatchStereo.FilterOptions(),
          control: control))
    }
  }
}
