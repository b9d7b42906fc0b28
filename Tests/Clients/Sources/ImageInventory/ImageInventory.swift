import CoreImage
import Foundation
import ImageIO
import UniformTypeIdentifiers
import os

/// Inspects photos in parallel before a reconstruction, and draws an overview image.
///
///     ImageInventory <photos> <overview.png>
@main
struct ImageInventory {
  struct Entry: Codable {
    var name: String
    var width: Int
    var height: Int
    var focalLength: Double?
  }

  static func main() throws {
    let start = CFAbsoluteTimeGetCurrent()
    let folder = URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true)
    let overview = URL(fileURLWithPath: CommandLine.arguments[2])
    let files = try FileManager.default.contentsOfDirectory(
      at: folder, includingPropertiesForKeys: [.fileSizeKey], options: [.skipsHiddenFiles]
    ).filter { UTType(filenameExtension: $0.pathExtension)?.conforms(to: .image) == true }
      .sorted { $0.lastPathComponent < $1.lastPathComponent }
    let entries = OSAllocatedUnfairLock(initialState: [Int: Entry]())
    DispatchQueue.concurrentPerform(iterations: files.count) { index in
      let entry = autoreleasepool { inspect(at: files[index]) }
      entries.withLock { $0[index] = entry }
    }
    let found = entries.withLock { all in files.indices.compactMap { all[$0] } }
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.sortedKeys, .withoutEscapingSlashes]
    print(String(decoding: try encoder.encode(Array(found.prefix(1))), as: UTF8.self))
    try drawOverview(of: files.prefix(9), to: overview)
    let seconds: CFTimeInterval = CFAbsoluteTimeGetCurrent() - start
    DispatchQueue.main.async { CFRunLoopStop(CFRunLoopGetMain()) }
    CFRunLoopRun()
    print("inspected \(found.count) of \(files.count)", seconds < 60)
  }

  static func inspect(at file: URL) -> Entry? {
    guard let source = CGImageSourceCreateWithURL(file as CFURL, nil),
      let properties = CGImageSourceCopyPropertiesAtIndex(source, 0, nil) as? [CFString: Any],
      let width = (properties[kCGImagePropertyPixelWidth] as? NSNumber)?.intValue,
      let height = (properties[kCGImagePropertyPixelHeight] as? NSNumber)?.intValue
    else { return nil }
    let exif = properties[kCGImagePropertyExifDictionary] as? [CFString: Any]
    return Entry(
      name: file.lastPathComponent, width: width, height: height,
      focalLength: exif?[kCGImagePropertyExifFocalLength] as? Double)
  }

  static func drawOverview(of files: some Collection<URL>, to overview: URL) throws {
    let side: CGFloat = 96
    let rendering = CIContext()
    guard
      let context = CGContext(
        data: nil, width: 3 * Int(side), height: 3 * Int(side), bitsPerComponent: 8,
        bytesPerRow: 0, space: CGColorSpaceCreateDeviceRGB(),
        bitmapInfo: CGImageAlphaInfo.noneSkipLast.rawValue)
    else { throw CocoaError(.featureUnsupported) }
    for (number, file) in files.enumerated() {
      guard let image = CIImage(contentsOf: file, options: [.applyOrientationProperty: true]) else {
        continue
      }
      let scale = side / max(image.extent.width, image.extent.height)
      let small = image.transformed(by: CGAffineTransform(scaleX: scale, y: scale))
      guard let pixels = rendering.createCGImage(small, from: small.extent) else { continue }
      let corner = CGPoint(x: CGFloat(number % 3) * side, y: CGFloat(number / 3) * side)
      let size = CGSize(width: pixels.width, height: pixels.height)
      context.draw(pixels, in: CGRect(origin: corner, size: size))
    }
    guard let image = context.makeImage(),
      let file = CGImageDestinationCreateWithURL(
        overview as CFURL, UTType.png.identifier as CFString, 1, nil)
    else { throw CocoaError(.fileWriteUnknown) }
    CGImageDestinationAddImage(file, image, nil)
    guard CGImageDestinationFinalize(file) else { throw CocoaError(.fileWriteUnknown) }
  }
}
