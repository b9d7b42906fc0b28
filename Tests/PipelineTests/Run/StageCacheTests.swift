import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct StageCacheTests {
  private func cache(
    _ directory: URL? = nil, access: CheckpointAccess = .exclusive
  ) -> StageCache {
    let configuration = PipelineConfiguration()
    return StageCache(
      directory: directory, access: access, sealsStages: true,
      recorder: RunRecorder(configuration, flag: CancellationFlag(), onEvent: { _ in }))
  }

  @Test func aFinerResultServesCoarserRequests() throws {
    let cache = cache()
    var made: [Int] = []
    for viewPixels in [100, 100, 50, 200, 100] {
      _ = try cache.surface(viewPixels: viewPixels) {
        made.append(viewPixels)
        return Mesh()
      }
    }
    #expect(made == [100, 200])
  }

  @Test func theCloudIsMadeAgainAfterItWasDropped() throws {
    let cache = cache()
    var count = 0
    for _ in 0..<2 {
      for _ in 0..<2 {
        _ = try cache.cloud(viewPixels: 100) {
          count += 1
          return PointCloud()
        }
      }
      cache.dropReproducible()
    }
    #expect(count == 2)
  }

  @Test func failuresAreNotKept() throws {
    let cache = cache()
    #expect(throws: PipelineError.emptyCrop) {
      try cache.surface(viewPixels: 1) { throw PipelineError.emptyCrop }
    }
    var count = 0
    for _ in 0..<2 {
      _ = try cache.surface(viewPixels: 1) {
        count += 1
        return Mesh()
      }
    }
    #expect(count == 1)
  }

  @Test func oneRunHasTheDirectoryUntilItUnlocks() throws {
    let folder = try TemporaryFolder()
    let (first, second) = (cache(folder.url), cache(folder.url))
    try first.lockDirectory()
    try first.lockDirectory()
    #expect(throws: CheckpointError.self) { try second.lockDirectory() }
    // The other run does not write its report there either.
    try second.writeReport()
    let report = folder.url.appendingPathComponent("report.json")
    #expect(!FileManager.default.fileExists(atPath: report.path))
    try first.writeReport()
    #expect(FileManager.default.fileExists(atPath: report.path))
    first.unlock()
    try second.lockDirectory()
  }

  @Test func jobsShareTheDirectory() throws {
    let folder = try TemporaryFolder()
    let caches = (0..<2).map { _ in cache(folder.url, access: .shared) }
    for cache in caches { try cache.lockDirectory() }
    withExtendedLifetime(caches) {
      _ = #expect(throws: CheckpointError.self) { try self.cache(folder.url).lockDirectory() }
    }
  }

  @Test func withoutADirectoryThereIsNothingToLock() throws {
    let caches = [cache(), cache()]
    for cache in caches {
      #expect(throws: Never.self) {
        try cache.lockDirectory()
        try cache.writeReport()
      }
    }
  }
}
