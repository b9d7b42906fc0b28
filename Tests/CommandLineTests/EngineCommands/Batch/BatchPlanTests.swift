import Foundation
import Pipeline
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite struct BatchPlanTests {
  private func plan(
    datasets: Int = 20, jobs: Int? = nil, threads: Int? = nil, gigabytes: Int = 64
  ) -> BatchPlan {
    BatchPlan(
      datasets: datasets, requestedJobs: jobs, requestedThreads: threads, processors: 8,
      memory: gigabytes << 30, memoryOfJob: 2 << 30)
  }

  @Test func processorsAreDistributed() {
    #expect((plan().jobs, plan().threads) == (8, 1))
    #expect((plan(datasets: 3).jobs, plan(datasets: 3).threads) == (3, 3))
    #expect((plan(jobs: 2).jobs, plan(jobs: 2).threads) == (2, 4))
    #expect((plan(jobs: 2, threads: 1).jobs, plan(jobs: 2, threads: 1).threads) == (2, 1))
    #expect(plan(datasets: 0).jobs == 1)
  }

  @Test func jobsFitIntoMemory() {
    #expect((plan(gigabytes: 7).jobs, plan(gigabytes: 7).threads) == (3, 3))
    #expect(!plan(gigabytes: 7).isLimitedByMemory)
    #expect(plan(jobs: 5, gigabytes: 7).jobs == 3 && plan(jobs: 5, gigabytes: 7).isLimitedByMemory)
    #expect(plan(gigabytes: 1).jobs == 1)
    #expect(DetailChoice.level(.preview).expectedMemoryBytes >= Machine.neededMemoryBytes)
  }

  @Test(arguments: [
    [], ["--up=-y"],
    ["-d", "full", "-o", "sequential", "-f", "high", "--no-object-masking", "--refine"],
    [
      "-d", "custom", "--max-polygons", "900", "--texture-side", "1024", "--maps",
      "color,occlusion", "--texture-format", "jpeg:0.7", "--keep-gaps", "--quads", "--crop",
      "-1,-0.25,0.125,1,2,3e-1",
    ],
  ])
  func optionsReachTheProcessOfADataset(_ words: [String]) throws {
    let batch = try Batch.parse(["a", "b"] + words)
    let run = try ReconstructArguments<PipelineArguments>.parse(
      ["a", "b.usdz"] + batch.modelArguments)
    #expect(run.detail.detail == batch.detail.detail)
    #expect(run.detail.specification == batch.detail.specification)
    #expect(run.alignment.sampleOrdering == batch.alignment.sampleOrdering)
    #expect(run.alignment.featureSensitivity == batch.alignment.featureSensitivity)
    #expect(run.noObjectMasking == batch.noObjectMasking)
    #expect(run.engine.surface.keepGaps == batch.surface.keepGaps)
    #expect(run.engine.surface.refine == batch.surface.refine)
    #expect(run.engine.frame.up?.direction == batch.frame.up?.direction)
    #expect(run.shape.crop == batch.shape.crop && run.shape.quads == batch.shape.quads)
    // No option is lost.
    for word in words where word.hasPrefix("--") { #expect(batch.modelArguments.contains(word)) }
  }

  @Test(arguments: [
    ["--jobs", "0"], ["--retries", "-1"], ["--threads", "0"], ["--format", "obj"],
  ])
  func invalidOptionsAreRejected(_ words: [String]) {
    #expect(throws: (any Error).self) { try Batch.parse(["a", "b"] + words) }
  }

  @Test func datasetsAreFoldersOfPhotos() throws {
    let temporary = try TemporaryFolder()
    let names = [
      "set10/1.jpg", "set2/images/1.png", "set2/cameras.txt", "Both/images/2.jpg", "Both/1.JPG",
      ".hidden/1.jpg", "models/1.usdz", "alone.jpg",
    ]
    for name in names { try temporary.write([0], as: name) }
    let models = temporary.url.appendingPathComponent("models", isDirectory: true)
    let found = try BatchDataset.all(in: temporary.url, except: models)
    #expect(found.map(\.name) == ["Both", "set2", "set10"])
    #expect(found.map(\.photos.lastPathComponent) == ["Both", "images", "set10"])
    #expect(found.map(\.photoCount) == [1, 1, 1])
  }

  @Test func datasetsHaveTheirMasksAndMeasurements() throws {
    let temporary = try TemporaryFolder()
    for name in [
      "a/images/1.jpg", "a/masks/1.png", "a/measurements.json", "b/1.jpg", "b/masks/1.png",
    ] {
      try temporary.write([0], as: name)
    }
    let models = temporary.url.appendingPathComponent("models", isDirectory: true)
    let found = try BatchDataset.all(in: temporary.url, except: models)
    let (a, b) = (try #require(found.first), try #require(found.last))
    #expect(
      a.arguments.count == 4 && a.arguments[0] == "--masks" && a.arguments[2] == "--measurements")
    #expect(
      a.arguments[1].hasSuffix("/a/masks") && a.arguments[3].hasSuffix("/a/measurements.json"))
    // Masks next to photos are found without an option.
    #expect(b.arguments.isEmpty)
    let run = try ReconstructArguments<PipelineArguments>.parse(["a", "b.usdz"] + a.arguments)
    #expect(
      run.engine.masking.masks == a.arguments[1] && run.engine.scale.measurements == a.arguments[3])
    let fingerprint = a.fingerprint(options: [])
    try temporary.write([0, 1], as: "a/masks/1.png")
    #expect(a.fingerprint(options: []) != fingerprint)
  }

  @Test func fingerprintChangesWithPhotosMasksAndOptions() throws {
    let temporary = try TemporaryFolder()
    try temporary.write([1, 2], as: "a/1.jpg")
    let models = temporary.url.appendingPathComponent("models", isDirectory: true)
    let dataset = try #require(try BatchDataset.all(in: temporary.url, except: models).first)
    var fingerprints = [dataset.fingerprint(options: ["x"])]
    #expect(dataset.fingerprint(options: ["x"]) == fingerprints[0] && fingerprints[0].count == 16)
    fingerprints.append(dataset.fingerprint(options: ["y"]))
    try temporary.write([1, 2, 3], as: "a/1.jpg")
    fingerprints.append(dataset.fingerprint(options: ["x"]))
    try FileManager.default.setAttributes(
      [.modificationDate: Date(timeIntervalSince1970: 1)],
      ofItemAtPath: temporary.url.path + "/a/1.jpg")
    fingerprints.append(dataset.fingerprint(options: ["x"]))
    try temporary.write([1], as: "a/masks/1.png")
    fingerprints.append(dataset.fingerprint(options: ["x"]))
    #expect(Set(fingerprints).count == fingerprints.count)
  }
}
