import CoreGraphics
import CoreImage
import CoreVideo
import Foundation
import ImageIO
import Metal

/// Rotates, crops and renders images.
func useRendering(_ photo: URL) throws {
  guard
    let image = CIImage(contentsOf: photo, options: [CIImageOption.applyOrientationProperty: true])
  else { return check(false, "a photo is an image") }
  check(image.url == photo && image.cgImage != nil, "the source of the image")
  check(image.properties[kCGImagePropertyOrientation] as? Int == 1, "upright")
  let (width, height) = (Int(image.extent.width), Int(image.extent.height))
  let context = CIContext(options: [
    CIContextOption.cacheIntermediates: false, .useSoftwareRenderer: true,
    .workingColorSpace: NSNull(), .outputColorSpace: NSNull(),
  ])
  var buffer: CVPixelBuffer?
  CVPixelBufferCreate(nil, width, height, kCVPixelFormatType_32BGRA, nil, &buffer)
  guard let buffer else { return check(false, "a buffer") }
  context.render(image, to: buffer)
  let same = CIImage(cvPixelBuffer: buffer)
  guard let pixels = context.createCGImage(same, from: same.extent),
    let original = context.createCGImage(image, from: image.extent)
  else { return check(false, "pixels") }
  check(pixels.dataProvider?.data == original.dataProvider?.data, "rendered unchanged")
  let turned = image.oriented(CGImagePropertyOrientation.right)
  check(turned.extent.size == CGSize(width: height, height: width), "a quarter turn")
  let again = turned.oriented(forExifOrientation: 8)
  let back = context.createCGImage(again, from: again.extent)
  check(back?.dataProvider?.data == original.dataProvider?.data, "and back")
  let half = image.transformed(by: CGAffineTransform(scaleX: 0.5, y: 0.5))
  check(half.extent.width == CGFloat(width) / 2, "half of it")
  let part = CIImage(cgImage: original).cropped(to: CGRect(x: 0, y: 0, width: 8, height: 4))
  check(context.createCGImage(part, from: part.extent)?.height == 4, "a part")
  if let device = MTLCreateSystemDefaultDevice() {
    let other = CIContext(mtlDevice: device, options: nil)
    check(other.createCGImage(part, from: part.extent)?.width == 8, "with a device")
  }
  try write(part, with: context)
}

private func write(_ image: CIImage, with context: CIContext) throws {
  let space = CGColorSpaceCreateDeviceRGB()
  let quality = CIImageRepresentationOption(
    rawValue: kCGImageDestinationLossyCompressionQuality as String)
  let data = context.jpegRepresentation(of: image, colorSpace: space, options: [quality: 0.5])
  check(data.flatMap { CIImage(data: $0) }?.extent.width == 8, "JPEG")
  check(
    context.pngRepresentation(of: image, format: CIFormat.RGBA8, colorSpace: space) != nil, "PNG")
  let url = FileManager.default.temporaryDirectory
    .appendingPathComponent("\(ProcessInfo.processInfo.processIdentifier)-part")
  defer { try? FileManager.default.removeItem(at: url) }
  try context.writeJPEGRepresentation(of: image, to: url, colorSpace: space)
  try context.writePNGRepresentation(of: image, to: url, format: .BGRA8, colorSpace: space)
  check(CIImage(contentsOf: url) != nil, "a file")
  let heic = context.heifRepresentation(
    of: image, format: .RGBA8, colorSpace: space, options: [quality: 0.8])
  check(heic.flatMap { CIImage(data: $0) }?.extent == image.extent, "HEIC")
  try context.writeHEIFRepresentation(of: image, to: url, format: .RGBA8, colorSpace: space)
  check(CIImage(contentsOf: url)?.extent == image.extent, "a file again")
}
