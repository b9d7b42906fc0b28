import SceneModel

/// Keeps the object that the photos are aimed at, and removes its support and background.
///
/// The support is the dominant near-horizontal plane in the region that most photos cover; the
/// object is the connected component above it around the focus of the optical axes.
struct ObjectIsolation {
  /// The points of the object, or all points if there is no clear object.
  struct Result: Sendable {
    /// Whether each input point belongs to the object.
    var isKept: [Bool]
    /// The plane that the object stands on; nil if none was found.
    var support: SupportPlane?
    /// Why there is no clear object; then all finite points are kept.
    var failure: String?
  }

  var options = Options()

  /// Classifies the points of `cloud`; a cloud without a clear object is a result, not an error.
  func run(
    _ cloud: PointCloud, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> Result {
    let downsampling = VoxelDownsampling(
      options: {
        var o = VoxelDownsampling.Options(); o.voxelFootprints = options.sampleFootprints; return o
      }())
    let samples = try downsampling.run(cloud, context.part(from: 0, to: 0.5))
    let outcome =
      try IsolationSamples(samples, reconstruction, options)
      .map { try $0.isolate(context.part(from: 0.5, to: 1)) } ?? .failure("no photo sees it.")
    switch outcome {
    case .object(let isObject, let support):
      let isKept = samples.sampleOfPoint.map { $0 >= 0 && isObject[Int($0)] }
      return Result(isKept: isKept, support: support)
    case .failure(let reason):
      return Result(
        isKept: samples.sampleOfPoint.map { $0 >= 0 }, support: nil, failure: reason)
    }
  }
}
