import CoreVideo
import Foundation
import RealityKit

/// Makes a model from photos in memory, which are passed to the session one after another, each
/// with a mask. Here they come from files; a real program would take them from a camera or a
/// renderer.
///
///     SampleSequence <photos> <model.usdz>
@main
struct SampleSequence {
  static func main() async throws {
    let arguments = CommandLine.arguments
    guard arguments.count == 3 else {
      print("usage: SampleSequence <photos> <model.usdz>")
      exit(2)
    }
    let files = try FileManager.default.contentsOfDirectory(
      at: URL(fileURLWithPath: arguments[1], isDirectory: true), includingPropertiesForKeys: nil
    ).sorted { $0.lastPathComponent < $1.lastPathComponent }

    var configuration = PhotogrammetrySession.Configuration()
    configuration.sampleOrdering = .sequential
    let session = try PhotogrammetrySession(
      input: Samples(files: files), configuration: configuration)

    let model = PhotogrammetrySession.Request.modelEntity(detail: .preview)
    let file = PhotogrammetrySession.Request.modelFile(
      url: URL(fileURLWithPath: arguments[2]), detail: .preview)
    try session.process(requests: [.poses, model, file])
    for try await output in session.outputs {
      switch output {
      case .requestComplete(_, .poses(let poses)):
        print("\(poses.posesBySample.count) of \(files.count) photos were registered.")
      case .requestComplete(_, .modelEntity(let entity)):
        describe(entity)
      case .requestComplete(_, .modelFile(let url)):
        print("Wrote \(url.path)")
      case .requestError(_, let error):
        print("error: \(error.localizedDescription)")
        exit(1)
      case .processingComplete, .processingCancelled:
        return
      default:
        continue
      }
    }
  }

  private static func describe(_ entity: ModelEntity) {
    guard let model = entity.model else { return }
    let triangles = model.mesh.contents.models.flatMap(\.parts)
      .map { ($0.triangleIndices?.count ?? 0) / 3 }.reduce(0, +)
    let size = entity.visualBounds(relativeTo: nil).extents
    print("\(triangles) triangles, \(model.materials.count) material, \(size) large.")
  }
}

/// Each photo is loaded when the session requests it, on the session's thread, and released after
/// it was read. A closure in `main` can't do that: in Swift 6 it is isolated to the main actor.
private struct Samples: Sequence, IteratorProtocol {
  var files: [URL]
  private var id = 0

  init(files: [URL]) { self.files = files }

  mutating func next() -> PhotogrammetrySample? {
    while id < files.count {
      defer { id += 1 }
      if let sample = try? Self.sample(id, files[id]) { return sample }
    }
    return nil
  }

  /// A photo with its metadata and mask.
  private static func sample(_ id: Int, _ file: URL) throws -> PhotogrammetrySample {
    let photo = try PhotogrammetrySample(contentsOf: file)
    var sample = PhotogrammetrySample(id: id, image: photo.image)
    sample.metadata = photo.metadata
    sample.objectMask = mask(of: photo.image)
    return sample
  }

  /// A mask that excludes the outermost pixels: 255 is the object, 0 is background.
  private static func mask(of image: CVPixelBuffer) -> CVPixelBuffer? {
    let (width, height) = (CVPixelBufferGetWidth(image), CVPixelBufferGetHeight(image))
    var buffer: CVPixelBuffer?
    CVPixelBufferCreate(
      kCFAllocatorDefault, width, height, kCVPixelFormatType_OneComponent8, nil, &buffer)
    guard let mask = buffer else { return nil }
    CVPixelBufferLockBaseAddress(mask, [])
    defer { CVPixelBufferUnlockBaseAddress(mask, []) }
    guard let bytes = CVPixelBufferGetBaseAddress(mask) else { return nil }
    for row in 1..<height - 1 {
      memset(bytes + row * CVPixelBufferGetBytesPerRow(mask) + 1, 255, width - 2)
    }
    return mask
  }
}
