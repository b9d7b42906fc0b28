import ArgumentParser
import Evaluation
import Foundation
import Kernels
import Pipeline
import SceneModel
import TestSupport

/// Matches and maps one synthetic scene and prints the cost and the errors as one line of JSON.
///
/// Each measurement is a separate process, so that the peak memory is that of one run;
/// `scripts/benchmark-growth` runs all sizes and prints the table.
@main
struct GrowthBenchmark: ParsableCommand {
  enum Mapping: String, CaseIterable, ExpressibleByArgument {
    case automatic, incremental, global, none

    /// Nil: matching only.
    var method: MappingMethod? { MappingMethod(rawValue: rawValue) }
  }

  static let configuration = CommandConfiguration(commandName: "growth-benchmark")

  @Option(help: "Number of photos.") var photos = 50
  @Option(help: "streets or orbits.") var layout = GrowthScene.Layout.streets
  @Option(help: "automatic, incremental, global, or none to match only.")
  var mapping = Mapping.automatic
  @Option(help: "Maximum number of features per photo.") var features = 2500
  @Option(help: "Threads.") var threads = 2
  @Option(help: "Seed of the scene.") var seed: UInt64 = 1
  @Flag(help: "Shuffle the photos.") var shuffled = false
  @Flag(help: "Declare the photos to be in the order of capture.") var sequential = false

  func run() throws {
    let control = KernelControl(threadCount: threads)
    let scene = try GrowthScene(sceneOptions, control)
    let start = ResourceUsage.now
    var camera = scene.camera
    camera.calibration = .exif
    let context = StageContext(control: control)
    let (graph, cameras) = try CorrespondenceSearch().run(
      photos: scene.photos, cameras: [camera], features: scene.features,
      ordering: sequential ? .sequential : .unordered,
      context)
    let matched = ResourceUsage.now
    var result = Result(scene, graph, context.notes)
    result.matching = Cost(from: start, to: matched)
    if let mapped = try map(graph, cameras, scene, context) {
      result.mapping = Cost(from: matched, to: .now)
      try result.compare(mapped, scene)
    }
    result.peakMemoryBytes = ResourceUsage.now.peakMemoryBytes
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.sortedKeys]
    print(String(decoding: try encoder.encode(result), as: UTF8.self))
  }

  private var sceneOptions: GrowthScene.Options {
    var options = GrowthScene.Options()
    (options.layout, options.photoCount, options.seed) = (layout, photos, seed)
    (options.featuresPerPhoto, options.isShuffled) = (features, shuffled)
    return options
  }

  private func map(
    _ graph: ViewGraph, _ cameras: [Camera], _ scene: GrowthScene, _ context: StageContext
  ) throws -> Reconstruction? {
    guard let method = mapping.method else { return nil }
    var options = SparseMapping.Options()
    options.method = method
    return try SparseMapping(options).run(
      graph, features: scene.features, photos: scene.photos, cameras: cameras, context)
  }
}

extension GrowthScene.Layout: ExpressibleByArgument {}
