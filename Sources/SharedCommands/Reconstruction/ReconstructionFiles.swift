import Formats
import Foundation
import SceneModel

/// What `reconstruct` reads and the files that it writes.
struct ReconstructionFiles {
  let input: PhotoInput
  let output: ModelOutput
  /// Coarse to fine.
  let coarserModels: [CoarserModel]
  let poses: URL?
  let pointCloud: URL?
  let checkpoint: URL?
  let additional: EngineOutputs

  /// Checks all paths; throws a `CommandFailure`. `formats` are those of model files.
  init<Engine>(
    _ arguments: ReconstructArguments<Engine>, input: PhotoInput, formats: [ModelFormat]
  ) throws {
    self.input = input
    output = try ModelOutput(arguments.output, formats: formats)
    coarserModels = try CoarserModel.all(arguments.detail, nextTo: output)
    try arguments.engine.check(output, arguments.detail)
    func url(_ path: String?, isDirectory: Bool = false) throws -> URL? {
      let url = path.map { URL(fileURLWithPath: $0, isDirectory: isDirectory) }
      if let url { try ModelOutput.checkWritable(url) }
      return url
    }
    poses = try url(arguments.poses)
    pointCloud = try url(arguments.pointCloud)
    additional = try arguments.engine.outputs(with: output)
    checkpoint = try url(arguments.checkpointDirectory, isDirectory: true)
  }

  /// Writes the result of a request, if a file was named for it.
  func store(
    _ result: PhotogrammetrySession.Result, _ reporter: RunReporter,
    intrinsics: (PhotogrammetrySession.Pose) -> PosesFile.Intrinsics?
  ) throws {
    switch result {
    case .modelFile(let url):
      reporter.wrote("model", url.relativePath)
      if url == output.url, let preview = additional.preview {
        reporter.wrote("preview", preview.relativePath)
      }
    case .poses(let result):
      guard let poses else { return }
      try AtomicFile.write(
        try PosesFile(result, intrinsics: intrinsics).encoded(), to: poses)
      reporter.wrote("poses", poses.relativePath)
    case .pointCloud(let cloud):
      guard let pointCloud else { return }
      let points = SceneModel.PointCloud(
        positions: cloud.points.map(\.position),
        colors: cloud.points.map { [$0.color.x, $0.color.y, $0.color.z] })
      try PLY.write(points, to: pointCloud)
      reporter.wrote("pointCloud", pointCloud.relativePath)
    default: break
    }
  }
}
