import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SceneStoreTests {
  private let scene = RaycastScene()

  private func views(of reconstruction: Reconstruction) throws -> DenseViews {
    try DenseViews(
      reconstruction, images: ImageStore(images: scene.views.map(\.image)),
      options: PointCloudGeneration.Options(), KernelControl())
  }

  private func photos(_ photos: [Photo]) -> PhotoSet {
    PhotoSet(
      IngestedPhotos(
        photos: photos, cameras: scene.reconstruction.cameras, rejected: [], files: [],
        rejectedMasks: [], contentHashes: photos.map { UInt64($0.id.index) },
        processingPixels: .max, isDownsampled: false),
      readings: [:], byteBudget: 0)
  }

  private func store(in folder: TemporaryFolder) -> SceneStore {
    SceneStore(units: UnitStore(folder: folder.url, isWritten: true), inputs: 5)
  }

  @Test func sparsePointsAreOnlyReadOfTheViewsThatNeedThem() throws {
    var reconstruction = scene.reconstruction
    reconstruction.poses[1] = nil
    let (views, photos) = (try views(of: reconstruction), photos(reconstruction.photos))
    let folder = try TemporaryFolder()
    let store = store(in: folder)
    #expect(store.scene(of: photos) == nil)
    try store.save(ObjectScene(photos, reconstruction), views)
    let found = try #require(store.scene(of: photos))
    let other = found.scene.reconstruction
    #expect(other.points.isEmpty && !reconstruction.points.isEmpty)
    #expect(other.cameras == reconstruction.cameras && other.poses == reconstruction.poses)
    #expect(other.photos.map(\.camera) == reconstruction.photos.map(\.camera))
    #expect(found.views.fingerprints == views.fingerprints)
    #expect(found.views.views.map(\.photo) == views.views.map(\.photo))
    #expect(found.views.views.map(\.camera) == views.views.map(\.camera))
    #expect(found.views.views.map(\.sources) == views.views.map(\.sources))
    #expect(found.views.points.allSatisfy { $0 == nil })
    let whole = store.scene(of: photos, withPointsOf: Block(index: 0, of: 1))
    #expect(whole?.views.points == views.points)
    #expect(store.scene(of: self.photos(reconstruction.photos.dropLast())) == nil)
  }

  @Test func samplesAreThoseThatWereStored() throws {
    let notes = StageNotes()
    notes.record("samples", 1)
    let cloud = PointCloud(
      positions: [[1, 2, 3]], normals: [[0, 0, 1]], colors: [[4, 5, 6]], consistency: [0.5],
      footprints: [0.1], photoOffsets: [0, 1], photoIndices: [3])
    let record = SampleRecord(
      samples: SurfaceSamples(cloud: cloud, voxelSize: 0.25, isObject: true, support: nil),
      denseNotes: SavedNotes(StageNotes()), notes: SavedNotes(notes))
    let folder = try TemporaryFolder()
    let store = store(in: folder)
    #expect(store.samples == nil)
    try store.save(record)
    let found = try #require(store.samples)
    #expect(found.samples.cloud.encoded() == cloud.encoded())
    #expect(found.samples.voxelSize == 0.25 && found.samples.isObject)
    #expect(found.notes.counts == ["samples": 1] && found.denseNotes.counts.isEmpty)
    let bytes = try record.unitData()
    for count in 0..<bytes.count { #expect(SampleRecord(unit: bytes.prefix(count)) == nil) }
  }

  @Test func pointsOfAFileAreThoseOfItsViews() throws {
    let points = (0..<70).map { view in
      (0..<view % 3).map { SIMD3<Double>(Double(view), Double($0), 0.5) }
    }
    var read: [[SIMD3<Double>]] = []
    for file in ViewPoints.files(of: 0..<70) {
      let own = Array(points[ViewPoints.views(of: file, count: 70)])
      let stored = try #require(ViewPoints(unit: try ViewPoints(own).unitData()))
      read += try #require(stored.points)
    }
    #expect(read == points)
    #expect(ViewPoints.files(of: 31..<33) == 0..<2 && ViewPoints.files(of: 32..<64) == 1..<2)
    #expect(ViewPoints.files(of: 5..<5).isEmpty)
  }

  @Test func aSceneWithDamagedMasksIsNotFound() throws {
    let (folder, other) = (try TemporaryFolder(), try TemporaryFolder())
    let file = other.url.appendingPathComponent("mask.png")
    let bytes: [UInt8] = [1, 2, 3]
    try Data(bytes).write(to: file)
    let reconstruction = scene.reconstruction
    var masks = [PhotoMask?](repeating: nil, count: reconstruction.photos.count)
    masks[2] = PhotoMask(
      file: file, orientation: 1, contentHash: bytes.withUnsafeBytes { XXHash64.hash($0) },
      coverage: 0.5)
    let (photos, store) = (photos(reconstruction.photos), store(in: folder))
    try store.save(
      ObjectScene(photos, reconstruction, masks: masks), try views(of: reconstruction))
    let found = try #require(store.scene(of: photos)).scene
    #expect(found.photos.ingested.photos[2].mask?.file == file)
    #expect(found.reconstruction.photos[2].mask?.coverage == 0.5)
    try Data([1, 2]).write(to: file)
    #expect(store.scene(of: photos) == nil)
  }
}
