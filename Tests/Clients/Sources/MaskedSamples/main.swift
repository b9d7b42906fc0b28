import CoreGraphics
import CoreVideo
import Foundation
import ImageIO
import RealityKit

// Photos and masks that are drawn into pixel buffers one by one, through type-erased iterators.
//
//     MaskedSamples <photos> <model.usdz>

/// The pixels of a photo in the format of a session; nothing here is isolated to the main actor.
enum Pixels {
  static func color(of url: URL, upTo side: Int) -> CVPixelBuffer? {
    guard let source = CGImageSourceCreateWithURL(url as CFURL, nil),
      let properties = CGImageSourceCopyPropertiesAtIndex(source, 0, nil) as? [CFString: Any],
      let width = properties[kCGImagePropertyPixelWidth] as? CGFloat,
      let height = properties[kCGImagePropertyPixelHeight] as? CGFloat,
      let image = CGImageSourceCreateImageAtIndex(source, 0, nil)
    else { return nil }
    let scale = min(1, CGFloat(side) / max(width, height))
    let size = CGSize(width: (width * scale).rounded(), height: (height * scale).rounded())
    let layout =
      CGImageAlphaInfo.premultipliedFirst.rawValue | CGBitmapInfo.byteOrder32Little.rawValue
    return drawn(size, kCVPixelFormatType_32BGRA, CGColorSpaceCreateDeviceRGB(), layout) {
      $0.interpolationQuality = .high
      $0.draw(image, in: CGRect(origin: .zero, size: size))
    }
  }

  static func mask(like buffer: CVPixelBuffer) -> CVPixelBuffer? {
    let (width, height) = (CVPixelBufferGetWidth(buffer), CVPixelBufferGetHeight(buffer))
    let frame = CGRect(x: 0, y: 0, width: width, height: height)
    let gray = CGColorSpaceCreateDeviceGray()
    return drawn(
      frame.size, kCVPixelFormatType_OneComponent8, gray, CGImageAlphaInfo.none.rawValue
    ) {
      $0.setFillColor(gray: 1, alpha: 1)
      $0.fill(frame.insetBy(dx: 2, dy: 2))
    }
  }

  private static func drawn(
    _ size: CGSize, _ format: OSType, _ space: CGColorSpace, _ layout: UInt32,
    draw: (CGContext) -> Void
  ) -> CVPixelBuffer? {
    let attributes = [kCVPixelBufferIOSurfacePropertiesKey: [:]] as CFDictionary
    var made: CVPixelBuffer?
    let status = CVPixelBufferCreate(
      kCFAllocatorDefault, Int(size.width), Int(size.height), format, attributes, &made)
    guard status == kCVReturnSuccess, let buffer = made else { return nil }
    CVPixelBufferLockBaseAddress(buffer, [])
    defer { CVPixelBufferUnlockBaseAddress(buffer, []) }
    let context = CGContext(
      data: CVPixelBufferGetBaseAddress(buffer), width: CVPixelBufferGetWidth(buffer),
      height: CVPixelBufferGetHeight(buffer), bitsPerComponent: 8,
      bytesPerRow: CVPixelBufferGetBytesPerRow(buffer), space: space, bitmapInfo: layout)
    guard let context else { return nil }
    draw(context)
    return buffer
  }

  static func samples(_ files: [URL]) -> AnySequence<PhotogrammetrySample> {
    AnySequence {
      var rest = files.enumerated().makeIterator()
      return AnyIterator {
        while let (number, file) = rest.next() {
          guard let image = color(of: file, upTo: 800) else { continue }
          var sample = PhotogrammetrySample(id: number, image: image)
          sample.objectMask = mask(like: image)
          return sample
        }
        return nil
      }
    }
  }
}

let arguments = CommandLine.arguments
let photos = URL(fileURLWithPath: (arguments[1] as NSString).expandingTildeInPath)
let keys: [URLResourceKey] = [.isRegularFileKey]
let found = FileManager.default.enumerator(at: photos, includingPropertiesForKeys: keys)
let files = (found?.allObjects as? [URL] ?? [])
  .filter { (try? $0.resourceValues(forKeys: Set(keys)))?.isRegularFile == true }
  .sorted {
    $0.lastPathComponent.localizedStandardCompare($1.lastPathComponent) == .orderedAscending
  }

let session = try PhotogrammetrySession(input: Pixels.samples(files))
try session.process(requests: [
  .modelFile(url: URL(fileURLWithPath: arguments[2]), detail: .preview)
])
for try await output in session.outputs {
  switch output {
  case .requestComplete(_, .modelFile(let url)):
    print("drew \(files.count) for \(url.lastPathComponent)")
  case .requestError(_, let error):
    let error = error as NSError
    print("\(error.domain) \(error.code): \(error.localizedDescription)")
    exit(1)
  case .invalidSample(let id, let reason): print("\(id): \(reason)")
  case .processingComplete: exit(0)
  default: break
  }
}
