import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct PatchWorkspaceTests {
  private static let scene: RaycastScene = {
    var options = RaycastScene.Options()
    (options.viewCount, options.width, options.height) = (4, 120, 90)
    return RaycastScene(options)
  }()

  private func run(
    _ scene: RaycastScene = Self.scene, _ reconstruction: Reconstruction? = nil, in folder: URL?,
    options: PointCloudGeneration.Options = .init(), notes: StageNotes = StageNotes(),
    control: KernelControl = KernelControl()
  ) throws -> PointCloud {
    try PointCloudGeneration(options: options).run(
      reconstruction ?? scene.reconstruction, images: ImageStore(images: scene.views.map(\.image)),
      folder: folder, StageContext(control: control, notes: notes))
  }

  private func reused(_ notes: StageNotes) -> Double? { notes.counts["reusedViews"] }

  private func names(_ folder: URL) throws -> [String] {
    try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted()
  }

  @Test func completeWorkspaceIsReused() throws {
    let folder = try TemporaryFolder()
    let first = try run(in: folder.url).encoded()
    #expect(try run(in: nil).encoded() == first)
    let steps = PatchWorkspace.Step.allCases.map(\.rawValue).sorted()
    #expect(steps.count == 9)
    #expect(
      try names(folder.url) == (0..<4).flatMap { view in steps.map { "000\(view).\($0)" } })
    let notes = StageNotes()
    #expect(try run(in: folder.url, notes: notes).encoded() == first)
    #expect(reused(notes) == 4)
    #expect(notes.details.contains { $0.contains("4 of 4 views") })
  }

  @Test func damagedFilesAreRecomputed() throws {
    let folder = try TemporaryFolder()
    let first = try run(in: folder.url).encoded()
    func content(_ name: String) throws -> [UInt8] {
      [UInt8](try Data(contentsOf: folder.url.appendingPathComponent(name)))
    }
    // The last steps' files are removed, so that those of the earlier steps are checked.
    for name in try names(folder.url)
    where name.hasSuffix(".cloud") || name.contains(".completed") {
      try FileManager.default.removeItem(at: folder.url.appendingPathComponent(name))
    }
    var flipped = try content("0000.patches")
    flipped[5000] ^= 1
    try folder.write(flipped, as: "0000.patches")
    try folder.write(Array(try content("0001.patches").dropLast(7)), as: "0001.patches")
    try folder.write(try content("0003.patches"), as: "0002.patches")
    try folder.write([], as: "0003.states")
    try folder.write(Array(try content("0002.view").prefix(40)), as: "0002.view")
    let notes = StageNotes()
    #expect(try run(in: folder.url, notes: notes).encoded() == first)
    #expect(reused(notes) == 1)
  }

  @Test func damagedCompletionIsRecomputed() throws {
    let folder = try TemporaryFolder()
    let first = try run(in: folder.url).encoded()
    for name in try names(folder.url) where name.hasSuffix(".cloud") {
      try FileManager.default.removeItem(at: folder.url.appendingPathComponent(name))
    }
    let file = folder.url.appendingPathComponent("0001.completed")
    var flipped = [UInt8](try Data(contentsOf: file))
    flipped[5000] ^= 1
    try folder.write(flipped, as: "0001.completed")
    try folder.write([], as: "0002.completedStates")
    let notes = StageNotes()
    #expect(try run(in: folder.url, notes: notes).encoded() == first)
    #expect(try [UInt8](Data(contentsOf: file)) != flipped)
    #expect(reused(notes) == 4)
  }

  @Test func finishedCloudsNeedNoOtherFiles() throws {
    let folder = try TemporaryFolder()
    let first = try run(in: folder.url).encoded()
    for name in try names(folder.url) where !name.hasSuffix(".cloud") {
      try FileManager.default.removeItem(at: folder.url.appendingPathComponent(name))
    }
    let notes = StageNotes()
    #expect(try run(in: folder.url, notes: notes).encoded() == first)
    #expect(reused(notes) == 4)
    #expect(try names(folder.url).count == 4)
  }

  @Test func anotherFilterKeepsThePatches() throws {
    let folder = try TemporaryFolder()
    _ = try run(in: folder.url)
    var options = PointCloudGeneration.Options()
    options.filter.photometricThreshold = 0.2
    let notes = StageNotes()
    let changed = try run(in: folder.url, options: options, notes: notes).encoded()
    #expect(reused(notes) == 4)
    #expect(try run(in: nil, options: options).encoded() == changed)
  }

  @Test func changedPatchOptionsAndPointsRecomputePatches() throws {
    let folder = try TemporaryFolder()
    _ = try run(in: folder.url)
    var options = PointCloudGeneration.Options()
    options.patches.seed = 9
    var notes = StageNotes()
    let changed = try run(in: folder.url, options: options, notes: notes).encoded()
    #expect(reused(notes) == 0)
    #expect(try run(in: nil, options: options).encoded() == changed)
    var reconstruction = Self.scene.reconstruction
    reconstruction.points.removeLast()
    notes = StageNotes()
    let fewer = try run(Self.scene, reconstruction, in: folder.url, options: options, notes: notes)
    #expect(try #require(reused(notes)) < 4)
    #expect(
      try run(Self.scene, reconstruction, in: nil, options: options).encoded() == fewer.encoded())
  }

  /// Views far apart along the arc have no sources in common.
  @Test func movedCameraAffectsOnlyItsNeighbors() throws {
    let folder = try TemporaryFolder()
    var reconstruction = Self.scene.reconstruction
    // Points of two photos each: 0 with 1, and 2 with 3.
    for index in reconstruction.points.indices {
      reconstruction.points[index].track.removeAll { ($0.photo.index < 2) != (index % 2 == 0) }
    }
    reconstruction.points.removeAll { $0.track.count < 2 }
    _ = try run(Self.scene, reconstruction, in: folder.url)
    reconstruction.poses[3]?.translation.x += 0.001
    let notes = StageNotes()
    let moved = try run(Self.scene, reconstruction, in: folder.url, notes: notes)
    #expect(reused(notes) == 2)
    #expect(try run(Self.scene, reconstruction, in: nil).encoded() == moved.encoded())
  }

  @Test func filesOfAnotherSceneAreIgnored() throws {
    let folder = try TemporaryFolder()
    var options = Self.scene.options
    options.floor = -1.1
    let other = RaycastScene(options)
    _ = try run(other, in: folder.url)
    let notes = StageNotes()
    let cloud = try run(in: folder.url, notes: notes)
    #expect(reused(notes) == 0)
    #expect(try run(in: nil).encoded() == cloud.encoded())
    // The same cameras and points, other pixels.
    let images = ImageStore(images: other.views.map(\.image))
    let again = StageNotes()
    _ = try PointCloudGeneration().run(
      Self.scene.reconstruction, images: images, folder: folder.url, StageContext(notes: again))
    #expect(reused(again) == 0)
  }

  @Test(arguments: [0.03, 0.5, 0.93, 0.97]) func stoppedRunIsResumed(stop: Double) throws {
    let folder = try TemporaryFolder()
    let flag = CancellationFlag()
    let control = KernelControl(threadCount: 2, flag: flag) { if $0 > stop { flag.cancel() } }
    #expect(throws: CancellationError.self) { try run(in: folder.url, control: control) }
    #expect(try !names(folder.url).contains { $0.hasPrefix(".") })
    #expect(try run(in: folder.url).encoded() == run(in: nil).encoded())
  }

  @Test(arguments: [0.5, 2]) func temporaryFoldersAreRemoved(stop: Double) throws {
    let parent = try TemporaryFolder()
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > stop { flag.cancel() } }
    var stage = PointCloudGeneration()
    stage.temporaryParent = parent.url
    let result = Result {
      try stage.run(
        Self.scene.reconstruction, images: ImageStore(images: Self.scene.views.map(\.image)),
        StageContext(control: control))
    }
    #expect((try? result.get()) == nil || stop > 1)
    #expect(try names(parent.url) == [])
  }

  @Test func filesOfKilledRunsAreRemoved() throws {
    let folder = try TemporaryFolder()
    let old = try folder.write([1], as: ".0000.view.A.partial")
    try folder.write([1], as: ".0001.view.B.partial")
    try FileManager.default.setAttributes(
      [.modificationDate: Date(timeIntervalSinceNow: -3600)], ofItemAtPath: old.path)
    _ = try PatchWorkspace(folder: folder.url)
    #expect(try names(folder.url) == [".0001.view.B.partial"])
  }

  @Test func sharesCombineToTheWholeResult() throws {
    let folder = try TemporaryFolder()
    let images = ImageStore(images: Self.scene.views.map(\.image))
    for index in [2, 0, 1] {
      let notes = StageNotes()
      try PointCloudGeneration().run(
        .init(index: index, of: 3), of: Self.scene.reconstruction, images: images,
        folder: folder.url, StageContext(notes: notes))
      #expect(reused(notes) == 0)
    }
    let notes = StageNotes()
    #expect(try run(in: folder.url, notes: notes).encoded() == run(in: nil).encoded())
    #expect(reused(notes) == 4)
    #expect(throws: KernelError.self) {
      try PointCloudGeneration().run(
        .init(index: 3, of: 3), of: Self.scene.reconstruction, images: images,
        folder: folder.url, StageContext())
    }
  }

  /// Two concurrent jobs, and one that finds all inputs from other views finished.
  @Test func concurrentJobsShareTheWork() throws {
    let folder = try TemporaryFolder()
    let url = folder.url
    let images = ImageStore(images: Self.scene.views.map(\.image))
    DispatchQueue.concurrentPerform(iterations: 2) { index in
      try? PointCloudGeneration().run(
        .init(index: index, of: 3), of: Self.scene.reconstruction, images: images,
        folder: url, StageContext())
    }
    let date = { (name: String) throws in
      try FileManager.default.attributesOfItem(
        atPath: folder.url.appendingPathComponent(name).path)[.modificationDate] as? Date
    }
    let coarse = try names(folder.url).filter { $0.hasSuffix(".coarse") }
    #expect(coarse.count == 4)
    let before = try coarse.map(date)
    try PointCloudGeneration().run(
      .init(index: 2, of: 3), of: Self.scene.reconstruction, images: images, folder: folder.url,
      StageContext())
    #expect(try coarse.map(date) == before)
    let notes = StageNotes()
    #expect(try run(in: folder.url, notes: notes).encoded() == run(in: nil).encoded())
    #expect(reused(notes) == 4)
  }

  @Test func progressIsMonotonic() throws {
    let folder = try TemporaryFolder()
    for expected in [40, 2] {
      let fractions = Locked<[Double]>([])
      _ = try run(
        in: folder.url, control: KernelControl { new in fractions.withLock { $0.append(new) } })
      let seen = fractions.withLock { $0 }
      #expect(zip(seen, seen.dropFirst()).allSatisfy { $0 <= $1 + 1e-12 })
      #expect(seen.count >= expected)
      #expect(try #require(seen.last) <= 1)
      #expect(seen.allSatisfy { $0 >= 0 })
    }
  }

  @Test(arguments: [1, 2]) func memoryDoesNotGrowWithViews(threads: Int) throws {
    var options = RaycastScene.Options()
    (options.viewCount, options.width, options.height) = (24, 48, 36)
    options.stepDegrees = 3
    let scene = RaycastScene(options)
    var stage = PointCloudGeneration.Options()
    stage.cacheBytes = 0
    let notes = StageNotes()
    _ = try run(
      scene, in: nil, options: stage, notes: notes, control: KernelControl(threadCount: threads))
    let bound = Double(threads * (1 + PatchStereo.maximumSources))
    #expect(notes.counts["views"] == 24)
    for name in ["peakMaps", "peakViews"] {
      let peak = try #require(notes.counts[name])
      #expect(peak >= 5)
      #expect(peak <= bound)
    }
  }

  @Test func fullDiskHasAMessage() throws {
    let folder = try TemporaryFolder()
    let workspace = try PatchWorkspace(folder: folder.url)
    try workspace.checkSpace(1)
    let error = #expect(throws: WorkspaceError.self) { try workspace.checkSpace(.max) }
    #expect(error?.errorDescription?.contains(folder.url.path) == true)
    #expect(error?.recoverySuggestion?.contains("lower detail level") == true)
    let file = try folder.write([], as: "file")
    #expect(throws: WorkspaceError.self) { try PatchWorkspace(folder: file) }
  }

  @Test func cloudSerializationRoundTrips() throws {
    let cloud = try run(in: nil)
    let bytes = [UInt8](cloud.encoded())
    var twice = PointCloud()
    let parts: [ArraySlice<UInt8>] = [bytes[...], bytes[...], bytes.dropLast(), [1, 2, 3]]
    let isTaken = parts.map { twice.append(encoded: $0) }
    #expect(isTaken == [true, true, false, false])
    #expect(twice.count == 2 * cloud.count)
    #expect(twice.positions.suffix(cloud.count) == cloud.positions[...])
    #expect(twice.colors.suffix(cloud.count) == cloud.colors[...])
    #expect(twice.visiblePhotos(of: twice.count - 1) == cloud.visiblePhotos(of: cloud.count - 1))
  }
}
