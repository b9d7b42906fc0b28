import Evaluation
import Pipeline
import SceneModel
import TestSupport

/// Time between two measurements.
struct Cost: Codable {
  var seconds = 0.0
  var cpuSeconds = 0.0

  init(from start: ResourceUsage, to end: ResourceUsage) {
    seconds = end.seconds - start.seconds
    cpuSeconds = end.cpuSeconds - start.cpuSeconds
  }
}

/// The results and the cost of one run.
struct Result: Codable {
  var layout: String
  var photos: Int
  /// Mean number of features per photo.
  var features: Int
  var pairs: Int
  var verifiedPairs: Int
  /// Verified pairs with fewer than ten common points.
  var wrongPairs: Int
  var matching: Cost?
  var mapping: Cost?
  var peakMemoryBytes = 0
  var registered: Int?
  var points: Int?
  var meanTrackLength: Double?
  /// The median error of the camera centers divided by their RMS distance from their mean.
  var relativeCenterError: Double?
  var areaUnderCurve: [PoseErrors.AreaUnderCurve]?
  var counts: [String: Double]

  init(_ scene: GrowthScene, _ graph: ViewGraph, _ notes: StageNotes) {
    layout = scene.options.layout.rawValue
    photos = scene.photos.count
    features = scene.features.reduce(0) { $0 + $1.count } / max(1, photos)
    pairs = Int(notes.counts["pairs"] ?? 0)
    verifiedPairs = graph.pairs.count
    let overlaps = scene.overlaps(minimum: 10)
    wrongPairs = graph.pairs.filter { overlaps[$0.pair] == nil }.count
    counts = notes.counts
  }

  /// Compares the poses with the true ones.
  mutating func compare(_ reconstruction: Reconstruction, _ scene: GrowthScene) throws {
    let truth = scene.photos.map {
      NamedCamera(name: $0.name, camera: scene.camera, cameraFromWorld: scene.poses[$0.id.index])
    }
    let statistics = ReprojectionStatistics(reconstruction)
    (registered, points) = (reconstruction.registered.count, statistics.points)
    meanTrackLength = statistics.meanTrackLength
    let errors = try PoseErrors.comparing(NamedCamera.cameras(of: reconstruction), with: truth)
      .errors
    let centers = scene.poses.map(\.center)
    let mean = centers.reduce(.zero, +) / Double(centers.count)
    let spread = centers.reduce(0) { $0 + ($1 - mean).squaredLength } / Double(centers.count)
    relativeCenterError = errors.centerMedian / spread.squareRoot()
    areaUnderCurve = errors.areaUnderCurve
  }
}
