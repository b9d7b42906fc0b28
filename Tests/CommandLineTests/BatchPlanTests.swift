import Foundation
import RealityFoundation
import TestSupport
import Testing

@testable import photogrammetry_cli

@Suite struct BatchPlanTests {
  private func plan(
    datasets: Int = 20, jobs: Int? = nil, threads: Int? = nil, gigabytes: Int = 64
  ) -> BatchPlan {
    BatchPlan(
      datasets: datasets, wishedJobs: jobs, wishedThreads: threads, processors: 8,
      memory: gigabytes << 30, memoryOfJob: 2 << 30)
  }

  @Test func processorsAreSharedOut() {
    #expect((plan().jobs, plan().threads) == (8, 1))
    #expect((plan(datasets: 3).jobs, plan(datasets: 3).threads) == (3, 3))
    #expect((plan(jobs: 2).jobs, plan(jobs: 2).threads) == (2, 4))
    #expect((plan(jobs: 2, threads: 1).jobs, plan(jobs: 2, threads: 1).threads) == (2, 1))
    #expect(plan(datasets: 0).jobs == 1)
  }

  @Test func jobsStayWithinTheMemory() {
    #expect((plan(gigabytes: 7).jobs, plan(gigabytes: 7).threads) == (3, 3))
    #expect(!plan(gigabytes: 7).isLimitedByMemory)
    #expect(plan(jobs: 5, gigabytes: 7).jobs == 3 && plan(jobs: 5, gigabytes: 7).isLimitedByMemory)
    #expect(plan(gigabytes: 1).jobs == 1)
    #expect(BatchPlan.memory(for: .level(.preview)) >= Machine.neededMemoryBytes)
  }

  @Test(arguments: [
    [], ["-d", "full", "-o", "sequential", "-f", "high", "--no-object-masking", "--refine"],
    [
      "-d", "custom", "--max-polygons", "900", "--texture-side", "1024", "--maps",
      "color,occlusion", "--texture-format", "jpeg:0.7", "--keep-gaps", "--quads", "--crop",
      "-1,-0.25,0.125,1,2,3e-1",
    ],
  ])
  func optionsAreHandedOn(_ words: [String]) throws {
    let batch = try Batch.parse(["a", "b"] + words)
    let run = try Reconstruct.parse(["a", "b.usdz"] + batch.modelWords)
    #expect(run.detail.detail == batch.detail.detail)
    #expect(run.detail.specification == batch.detail.specification)
    #expect(run.alignment.sampleOrdering == batch.alignment.sampleOrdering)
    #expect(run.alignment.featureSensitivity == batch.alignment.featureSensitivity)
    #expect(run.noObjectMasking == batch.noObjectMasking)
    #expect(run.surface.keepGaps == batch.surface.keepGaps)
    #expect(run.surface.refine == batch.surface.refine)
    #expect(run.shape.crop == batch.shape.crop && run.shape.quads == batch.shape.quads)
    // What is given is there at all.
    for word in words where word.hasPrefix("--") { #expect(batch.modelWords.contains(word)) }
  }

  @Test(arguments: [
    ["--jobs", "0"], ["--retries", "-1"], ["--threads", "0"], ["--format", "obj"],
  ])
  func wrongOptionsAreRefused(_ words: [String]) {
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

  @Test func datasetsHaveMasksAndMeasurementsOfTheirOwn() throws {
    let temporary = try TemporaryFolder()
    for name in [
      "a/images/1.jpg", "a/masks/1.png", "a/measurements.json", "b/1.jpg", "b/masks/1.png",
    ] {
      try temporary.write([0], as: name)
    }
    let models = temporary.url.appendingPathComponent("models", isDirectory: true)
    let found = try BatchDataset.all(in: temporary.url, except: models)
    let (a, b) = (try #require(found.first), try #require(found.last))
    #expect(a.words.count == 4 && a.words[0] == "--masks" && a.words[2] == "--measurements")
    #expect(a.words[1].hasSuffix("/a/masks") && a.words[3].hasSuffix("/a/measurements.json"))
    // Those of photos in the folder itself are found anyway.
    #expect(b.words.isEmpty)
    let run = try Reconstruct.parse(["a", "b.usdz"] + a.words)
    #expect(run.engine.masking.masks == a.words[1] && run.engine.measurements == a.words[3])
    let stamp = a.stamp(options: [])
    try temporary.write([0, 1], as: "a/masks/1.png")
    #expect(a.stamp(options: []) != stamp)
  }

  @Test func stampChangesWithPhotosMasksAndOptions() throws {
    let temporary = try TemporaryFolder()
    try temporary.write([1, 2], as: "a/1.jpg")
    let models = temporary.url.appendingPathComponent("models", isDirectory: true)
    let dataset = try #require(try BatchDataset.all(in: temporary.url, except: models).first)
    var stamps = [dataset.stamp(options: ["x"])]
    #expect(dataset.stamp(options: ["x"]) == stamps[0] && stamps[0].count == 16)
    stamps.append(dataset.stamp(options: ["y"]))
    try temporary.write([1, 2, 3], as: "a/1.jpg")
    stamps.append(dataset.stamp(options: ["x"]))
    try FileManager.default.setAttributes(
      [.modificationDate: Date(timeIntervalSince1970: 1)],
      ofItemAtPath: temporary.url.path + "/a/1.jpg")
    stamps.append(dataset.stamp(options: ["x"]))
    try temporary.write([1], as: "a/masks/1.png")
    stamps.append(dataset.stamp(options: ["x"]))
    #expect(Set(stamps).count == stamps.count)
  }
}
