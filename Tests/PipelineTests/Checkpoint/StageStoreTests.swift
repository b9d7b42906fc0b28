import Formats
import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SealedFileTests {
  let folder: TemporaryFolder
  let url: URL
  let payload = Data("what a stage has found".utf8)

  init() throws {
    folder = try TemporaryFolder()
    url = folder.url.appendingPathComponent("stage")
    try SealedFile.write(payload, madeFrom: 7, to: url)
  }

  @Test func contentRoundTrips() {
    #expect(SealedFile.read(url, madeFrom: 7) == payload)
  }

  @Test func filesFromOtherInputsCountAsMissing() {
    #expect(SealedFile.read(url, madeFrom: 8) == nil)
  }

  @Test func anyChangedByteIsDetected() throws {
    let whole = try Data(contentsOf: url)
    for index in whole.indices {
      var damaged = whole
      damaged[index] ^= 0x10
      try damaged.write(to: url)
      #expect(SealedFile.read(url, madeFrom: 7) == nil, "byte \(index)")
    }
  }

  @Test func anyTruncationIsDetected() throws {
    let whole = try Data(contentsOf: url)
    for count in 0..<whole.count {
      try whole.prefix(count).write(to: url)
      #expect(SealedFile.read(url, madeFrom: 7) == nil, "\(count) bytes")
    }
    try (whole + [0]).write(to: url)
    #expect(SealedFile.read(url, madeFrom: 7) == nil)
  }
}

@Suite struct StageStoreTests {
  let folder: TemporaryFolder
  let ingested: IngestedPhotos
  let reconstruction: Reconstruction

  init() throws {
    folder = try TemporaryFolder()
    let scene = SphereScene(viewCount: 5, imageSize: 64) { _ in SIMD3(120, 130, 140) }
    var reconstruction = scene.reconstruction
    reconstruction.poses[3] = nil
    reconstruction.points = [
      ScenePoint(
        position: [0.1, -1.0 / 3, 1e-17], color: [1, 2, 3], error: 0.25,
        track: [Observation(photo: ID(1), feature: 12, pixel: [3.7, 1.0 / 7])])
    ]
    reconstruction.worldFrame = WorldFrame(scale: .gps, up: .supportPlane)
    self.reconstruction = reconstruction
    ingested = IngestedPhotos(
      photos: reconstruction.photos, cameras: reconstruction.cameras, rejected: [], files: [],
      rejectedMasks: [], contentHashes: reconstruction.photos.indices.map { UInt64($0) },
      processingPixels: 1000, isDownsampled: false)
  }

  func store(
    _ ingested: IngestedPhotos? = nil, readings: [Int: SensorReading] = [:],
    _ change: (inout PipelineConfiguration) -> Void = { _ in }
  ) throws -> StageStore {
    var configuration = PipelineConfiguration()
    change(&configuration)
    return StageStore(
      checkpoint: Checkpoint(directory: folder.url),
      inputs: try RunInputs(
        PhotoSet(ingested ?? self.ingested, readings: readings, byteBudget: 0), configuration))
  }

  @Test func alignmentRoundTripsBitForBit() throws {
    let notes = StageNotes()
    notes.record("pairs", 12)
    notes.warn("A sentence.")
    try store().save(AlignedPhotos(reconstruction: reconstruction), notes)
    let replayed = StageNotes()
    let found = try #require(try store().alignment(of: ingested.photos, replayed)).reconstruction
    #expect(found.cameras == reconstruction.cameras)
    #expect(found.poses == reconstruction.poses)
    #expect(found.points == reconstruction.points)
    #expect(found.worldFrame == reconstruction.worldFrame)
    #expect(replayed.counts == ["pairs": 12])
    #expect(replayed.warnings == ["A sentence."])
  }

  @Test func alignmentOfOtherPhotosOrOptionsIsNotUsed() throws {
    try store().save(AlignedPhotos(reconstruction: reconstruction), StageNotes())
    var other = ingested
    other.contentHashes[2] += 1
    let others = [
      try store(other), try store(readings: [1: SensorReading(gravity: [0, 1, 0])]),
      try store(readings: [1: SensorReading(depth: DepthMap(width: 1, height: 1, depths: [2]))]),
      try store { $0.alignment.ordering = .sequential },
      try store { $0.alignment.features.sensitivity = .high },
      try store { $0.isObjectMaskingEnabled = false },
    ]
    for store in others {
      #expect(store.alignment(of: ingested.photos, StageNotes()) == nil)
    }
    // The options of the surface and the machine are irrelevant.
    let same = [
      try store { $0.photoRefinement = PhotoRefinement.Options() },
      try store { $0.threadCount = 1 },
    ]
    for store in same {
      let stored = try #require(
        store.alignment(of: ingested.photos, StageNotes())
      ).reconstruction
      #expect(stored.poses == reconstruction.poses && stored.points == reconstruction.points)
    }
  }

  @Test func masksOfAlignmentRoundTripBitForBit() throws {
    let (store, masks) = (try store(), try masks())
    try store.save(AlignedPhotos(reconstruction: reconstruction, masks: masks), StageNotes())
    let found = try #require(store.alignment(of: ingested.photos, StageNotes())?.masks)
    expect(found, equals: masks)
  }

  @Test func masksRoundTripBitForBit() throws {
    let (store, masks) = (try store(), try masks())
    try store.save(masks, StageNotes())
    expect(try #require(store.masks(StageNotes())), equals: masks)
  }

  @Test func alignmentWithoutItsMasksIsNotUsed() throws {
    let (store, masks) = (try store(), try masks())
    try store.save(AlignedPhotos(reconstruction: reconstruction, masks: masks), StageNotes())
    let file = try #require(masks.masks[1]?.file)
    try Data("another mask".utf8).write(to: file)
    #expect(store.alignment(of: ingested.photos, StageNotes()) == nil)
  }

  /// Masks of all photos but one, and points of the surroundings.
  private func masks() throws -> EstimatedMasks {
    var result = ObjectMasking.Result(photoCount: ingested.photos.count)
    for index in ingested.photos.indices.dropFirst() {
      result.masks[index] = RasterImage(
        width: 4, height: 3, channels: 1,
        pixels: (0..<12).map { $0 % (index + 1) == 0 ? 255 : 0 })
      result.agreement[index] = 1 / Double(index + 2)
    }
    let around = PointCloud(
      positions: [[0.1, -1 / 3, 1e-17], [1, 2, 3]], normals: [[0, 1, 0], [1, 0, 0]],
      colors: [[1, 2, 3], [4, 5, 6]], consistency: [0.7, 1], footprints: [0.01, 1 / 3],
      photoOffsets: [0, 2, 3], photoIndices: [1, 4, 2])
    result.points = LabeledCloud(cloud: around, isObject: [false, false])
    return try EstimatedMasks(
      result, of: ingested.photos, in: folder.url.appendingPathComponent("masks"),
      KernelControl())
  }

  private func expect(_ found: EstimatedMasks, equals masks: EstimatedMasks) {
    #expect(found.masks == masks.masks && found.agreement == masks.agreement)
    let (points, expected) = (found.surroundings, masks.surroundings)
    #expect(points.count == 2)
    #expect(points.positions == expected.positions && points.normals == expected.normals)
    #expect(points.colors == expected.colors && points.consistency == expected.consistency)
    #expect(points.footprints == expected.footprints)
    #expect(
      points.photoOffsets == expected.photoOffsets && points.photoIndices == expected.photoIndices)
  }

  @Test func surfaceIsUsedForWhatItWasMadeFrom() throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 2)
    func store(
      viewPixels: Int, _ change: (inout PipelineConfiguration) -> Void = { _ in }
    ) throws -> StageStore {
      try self.store {
        change(&$0)
        $0 = $0.specialized(for: DetailSpecification(.preview), viewPixels: viewPixels)
      }
    }
    let sealing = try store(viewPixels: 500)
    try sealing.checkpoint.write(mesh)
    try sealing.sealSurface(StageNotes(), denseNotes: StageNotes())
    #expect(try store(viewPixels: 500).surface(StageNotes())?.positions == mesh.positions)
    // The options of later stages are irrelevant.
    let retextured = try store(viewPixels: 500) { $0.textureMapping.textureSide = 1024 }
    #expect(retextured.surface(StageNotes()) != nil)
    let others = [
      try store(viewPixels: 501),
      try store(viewPixels: 500) { $0.meshGeneration.closesObject = false },
      try store(viewPixels: 500) { $0.photoRefinement = PhotoRefinement.Options() },
    ]
    for other in others { #expect(other.surface(StageNotes()) == nil) }
  }

  @Test func damagedSurfaceIsNotUsed() throws {
    let store = try store()
    try store.checkpoint.write(SyntheticMesh.sphere(subdivisions: 2))
    try store.sealSurface(StageNotes(), denseNotes: StageNotes())
    var bytes = try Data(contentsOf: store.checkpoint.surface)
    bytes[bytes.count - 20] ^= 1
    try bytes.write(to: store.checkpoint.surface)
    #expect(store.surface(StageNotes()) == nil)
  }
}

@Suite struct DirectoryLockTests {
  let folder: TemporaryFolder

  init() throws { folder = try TemporaryFolder() }

  @Test func onlyOneRunHasTheLock() throws {
    let lock = try DirectoryLock(folder.url, isShared: false)
    #expect(throws: CheckpointError.inUse(directory: folder.url.path)) {
      _ = try DirectoryLock(folder.url, isShared: false)
    }
    #expect(throws: CheckpointError.inUse(directory: folder.url.path)) {
      _ = try DirectoryLock(folder.url, isShared: true)
    }
    withExtendedLifetime(lock) {}
  }

  @Test func lockIsReleasedWithItsOwner() throws {
    for isShared in [false, true] {
      do {
        let lock = try DirectoryLock(folder.url, isShared: isShared)
        #expect(!isAvailable)
        withExtendedLifetime(lock) {}
      }
      #expect(isAvailable)
    }
  }

  /// Whether an exclusive lock can be taken now.
  private var isAvailable: Bool {
    (try? DirectoryLock(folder.url, isShared: false)) != nil
  }

  @Test func sharedLocksCoexist() throws {
    let first = try DirectoryLock(folder.url, isShared: true)
    let second = try DirectoryLock(folder.url, isShared: true)
    #expect(throws: CheckpointError.self) {
      _ = try DirectoryLock(folder.url, isShared: false)
    }
    withExtendedLifetime((first, second)) {}
  }
}
