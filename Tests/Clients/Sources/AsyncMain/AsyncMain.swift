import CoreGraphics
import CoreVideo
import Foundation
import ImageIO
import RealityKit

/// Samples that are loaded one by one, on request.
struct SampleLoader: Sequence, IteratorProtocol {
  var files: [URL]
  var count = 0

  mutating func next() -> PhotogrammetrySample? {
    while count < files.count {
      defer { count += 1 }
      guard var sample = try? PhotogrammetrySample(contentsOf: files[count]) else { continue }
      sample.metadata["FileName"] = files[count].lastPathComponent
      return PhotogrammetrySample(copying: sample, id: count)
    }
    return nil
  }
}

extension PhotogrammetrySample {
  /// The same photo with a separate buffer and a mask that excludes a two-pixel border.
  init?(copying sample: PhotogrammetrySample, id: Int) {
    let (width, height) = (
      CVPixelBufferGetWidth(sample.image), CVPixelBufferGetHeight(sample.image)
    )
    guard let image = Self.buffer(width, height, kCVPixelFormatType_32BGRA) else { return nil }
    CVPixelBufferLockBaseAddress(sample.image, .readOnly)
    CVPixelBufferLockBaseAddress(image, CVPixelBufferLockFlags(rawValue: 0))
    defer {
      CVPixelBufferUnlockBaseAddress(image, CVPixelBufferLockFlags(rawValue: 0))
      CVPixelBufferUnlockBaseAddress(sample.image, .readOnly)
    }
    guard let from = CVPixelBufferGetBaseAddress(sample.image),
      let to = CVPixelBufferGetBaseAddress(image)
    else { return nil }
    let (fromRow, toRow) = (
      CVPixelBufferGetBytesPerRow(sample.image), CVPixelBufferGetBytesPerRow(image)
    )
    for row in 0..<height { memcpy(to + row * toRow, from + row * fromRow, width * 4) }
    self.init(id: id, image: image)
    metadata = sample.metadata
    guard let mask = Self.buffer(width, height, kCVPixelFormatType_OneComponent8) else { return }
    CVPixelBufferLockBaseAddress(mask, [])
    defer { CVPixelBufferUnlockBaseAddress(mask, []) }
    let bytes = CVPixelBufferGetBaseAddress(mask)!.assumingMemoryBound(to: UInt8.self)
    let maskRow = CVPixelBufferGetBytesPerRow(mask)
    for y in 2..<height - 2 { for x in 2..<width - 2 { bytes[y * maskRow + x] = 255 } }
    objectMask = mask
    gravity = CMAcceleration(x: 0, y: -1, z: 0)
  }

  private static func buffer(_ width: Int, _ height: Int, _ format: OSType) -> CVPixelBuffer? {
    let attributes =
      [
        kCVPixelBufferCGImageCompatibilityKey: kCFBooleanTrue!,
        kCVPixelBufferCGBitmapContextCompatibilityKey: kCFBooleanTrue!,
      ] as CFDictionary
    var pixelBuffer: CVPixelBuffer? = nil
    let status = CVPixelBufferCreate(
      kCFAllocatorDefault, width, height, format, attributes, &pixelBuffer)
    guard status == kCVReturnSuccess else { return nil }
    return pixelBuffer
  }
}

@main
struct AsyncMain {
  static func main() async throws {
    let folder = URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true)
    let files = try FileManager.default.contentsOfDirectory(
      at: folder, includingPropertiesForKeys: nil
    ).sorted { $0.path < $1.path }
    let session = try PhotogrammetrySession(
      input: SampleLoader(files: files), configuration: PhotogrammetrySession.Configuration())
    let model = URL(fileURLWithPath: CommandLine.arguments[2])
    let outputs = session.outputs
    async let outcome: Int = follow(outputs)
    try session.process(requests: [.modelFile(url: model, detail: .preview)])
    let failures = try await outcome
    print(failures == 0 ? "made \(model.lastPathComponent)" : "\(failures) requests failed")
    exit(failures == 0 ? 0 : 1)
  }

  static func follow(_ outputs: PhotogrammetrySession.Outputs) async throws -> Int {
    var failures = 0
    for try await output in outputs {
      if case .requestError(_, let error) = output {
        print(error.localizedDescription)
        failures += 1
      }
      if case .processingComplete = output { return failures }
    }
    return failures
  }
}
