import Foundation
import RealityKit

/// Uses each symbol of the API once, and makes a model at the same time.
///
///     EverySymbol <photos> <folder for the model>
@main
struct EverySymbol {
  static func main() async throws {
    let photos = URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true)
    let folder = URL(fileURLWithPath: CommandLine.arguments[2], isDirectory: true)
    try useGeometry()
    useMachine()
    useDurations()
    useErrors(folder)
    guard let name = try FileManager.default.contentsOfDirectory(atPath: photos.path).sorted().first
    else { return check(false, "there are no photos") }
    let photo = photos.appendingPathComponent(name)
    try await useSamples(photo)
    try usePool()
    try useImages(photo)
    try useRendering(photo)
    useLogs()
    useContentTypes()
    try useSystem(photo)
    await usePublishers()
    let session = try Session(input: photos, configuration: makeConfiguration(checkpoint: folder))
    check(!session.isProcessing && session.activeRequests.isEmpty, "idle")
    check(session.configuration.meshPrimitive == .quad && session.id == session.id, "as configured")
    session.cancel()
    let requests = makeRequests(file: folder)
    try session.process(requests: requests)
    check(session.isProcessing && session.activeRequests.count == requests.count, "processing")
    let outputs: Session.Outputs = session.outputs
    var iterator: Session.Outputs.Iterator = outputs.makeAsyncIterator()
    let failure: Session.Outputs.Failure? = nil
    check(failure == nil, "no failure")
    var results = 0
    while let output: Session.Outputs.Element = try await iterator.next() {
      check(!output.localizedDescription.isEmpty, "every output has a description")
      if try take(output) { results += 1 }
      if case .processingComplete = output { break }
    }
    check(results == requests.count, "\(results) of \(requests.count) results")
    print("made \(results) results")
  }

  private static func useErrors(_ folder: URL) {
    let errors: [Session.Error] = [
      .invalidImages(folder), .invalidOutput(folder), .insufficientStorage(requiredBytes: 1),
    ]
    check(errors.map { ($0 as NSError).code } == [0, 1, 2], "codes")
    for error in errors {
      let sentences = [error.errorDescription, error.failureReason, error.recoverySuggestion]
      check(sentences.allSatisfy { $0?.isEmpty == false }, error.localizedDescription)
    }
    do {
      _ = try Session(input: folder.appendingPathComponent("missing"))
      check(false, "a missing folder is an error")
    } catch Session.Error.invalidImages(let url) {
      check(url.lastPathComponent == "missing", "the error names the folder")
    } catch {
      check(false, "\(error)")
    }
    check((try? Session(input: [PhotogrammetrySample]())) != nil, "an empty sequence is accepted")
  }

  /// Checks an output; returns whether it is a result.
  private static func take(_ output: Session.Output) throws -> Bool {
    switch output {
    case .inputComplete, .processingComplete: return false
    case .requestProgress(let request, fractionComplete: let fraction):
      check((0...1).contains(fraction) && !"\(request)".isEmpty, "progress")
      return false
    case .requestProgressInfo(_, let info): return use(info)
    case .requestComplete(_, let result):
      try take(result)
      return true
    case .requestError(let request, let error):
      check(false, "\(request): \(error)")
      return false
    case .invalidSample(id: let id, reason: let reason):
      check(false, "sample \(id): \(reason)")
      return false
    case .skippedSample(id: let id):
      check(false, "sample \(id)")
      return false
    case .processingCancelled, .automaticDownsampling, .stitchingIncomplete:
      check(false, output.localizedDescription)
      return false
    @unknown default: return false
    }
  }

  private static func use(_ info: Session.Output.ProgressInfo) -> Bool {
    let stages: [Session.Output.ProcessingStage] = [
      .preProcessing, .imageAlignment, .pointCloudGeneration, .meshGeneration, .textureMapping,
      .optimization,
    ]
    check((info.estimatedRemainingTime ?? 0) >= 0, "time")
    check(info.processingStage.map(stages.contains) ?? true, "stage")
    return false
  }

  private static func take(_ result: Session.Result) throws {
    switch result {
    case .modelFile(let url):
      let files = try FileManager.default.contentsOfDirectory(atPath: url.path)
      check(files.contains("baked_mesh.obj"), "\(files)")
      let text = try String(
        contentsOf: url.appendingPathComponent("baked_mesh.obj"), encoding: .utf8)
      let faces = text.split(separator: "\n").filter { $0.hasPrefix("f ") }
      check(faces.contains { $0.split(separator: " ").count == 5 }, "there are quads")
      check(faces.count > 300 && faces.count <= 6_000, "\(faces.count) faces")
    case .modelEntity(let entity): try useEntity(entity)
    case .bounds(let box): check(!box.isEmpty, "bounds")
    case .pointCloud(let cloud): use(cloud)
    case .poses(let poses): use(poses)
    @unknown default: check(false, "an unknown result")
    }
  }

  private static func use(_ cloud: Session.PointCloud) {
    let points: [Session.PointCloud.Point] = cloud.points
    check(points.count > 1000, "points")
    check(points.allSatisfy { $0.color.w == 255 && $0.position.x.isFinite }, "colors")
  }

  private static func use(_ poses: Session.Poses) {
    check(poses.posesBySample.count > 10, "poses")
    for (id, pose): (Int, Session.Pose) in poses.posesBySample {
      check(poses.urlsBySample[id] != nil, "a photo per pose")
      check(pose.transform.translation == pose.translation, "translation")
      check(pose.transform.rotation == pose.rotation, "rotation")
      check((pose.intrinsics?.columns.0.x ?? 0) > 0, "focal length")
      let lens: LensDistortionData? = pose.lensDistortionData
      check((lens?.radialLookupTable.count ?? 2) > 1 && (lens?.center.x ?? 1) > 0, "lens")
    }
    check(LensDistortionData(center: .zero, radialLookupTable: []).center == .zero, "made")
  }
}
