import CoreGraphics
import Foundation
import ImageIO

/// Reads, writes and draws images in memory and in files.
func useImages(_ photo: URL) throws {
  try useSource(photo)
  useProperties()
  useBitmaps()
  useColors()
  useTransforms()
}

private func useSource(_ photo: URL) throws {
  let options: [CFString: Any] = [
    kCGImageSourceShouldCache: false, kCGImageSourceShouldCacheImmediately: true,
    kCGImageSourceCreateThumbnailFromImageAlways: true,
    kCGImageSourceCreateThumbnailFromImageIfAbsent: true,
    kCGImageSourceCreateThumbnailWithTransform: true, kCGImageSourceThumbnailMaxPixelSize: 64,
  ]
  guard let source = CGImageSourceCreateWithURL(photo as CFURL, options as CFDictionary),
    let image = CGImageSourceCreateImageAtIndex(source, 0, nil),
    let small = CGImageSourceCreateThumbnailAtIndex(source, 0, options as CFDictionary),
    let properties = CGImageSourceCopyPropertiesAtIndex(source, 0, nil) as? [CFString: Any]
  else { return check(false, "a photo is an image") }
  check(CGImageSourceGetCount(source) == 1 && max(small.width, small.height) == 64, "thumbnail")
  check(CGImageSourceGetPrimaryImageIndex(source) == 0, "the only image")
  check(CGImageSourceGetType(source) == "public.jpeg", "type")
  check(CGImageSourceGetStatus(source) == CGImageSourceStatus.statusComplete, "status")
  check(properties[kCGImagePropertyPixelWidth] as? Int == image.width, "width")
  guard let provider = CGDataProvider(url: photo as CFURL),
    let same = CGImage(
      jpegDataProviderSource: provider, decode: nil, shouldInterpolate: true,
      intent: .defaultIntent)
  else { return check(false, "a file is an image") }
  check(same.width == image.width, "the same file")
  let other = CGImage(
    pngDataProviderSource: provider, decode: nil, shouldInterpolate: false, intent: .perceptual)
  check(other == nil, "not a PNG")
  check(properties[kCGImagePropertyPixelHeight] as? Double == Double(image.height), "height")
  check((properties[kCGImagePropertyOrientation] as? NSNumber)?.intValue == 1, "upright")
  check(properties[kCGImagePropertyColorModel] as? String == kCGImagePropertyColorModelRGB, "RGB")
  let file = CGImageSourceCopyProperties(source, nil)
  check((file?[kCGImagePropertyFileSize] as? NSNumber)?.intValue ?? 0 > 1000, "bytes")
  for type in [kCGImageAuxiliaryDataTypeDepth, kCGImageAuxiliaryDataTypeDisparity] {
    check(CGImageSourceCopyAuxiliaryDataInfoAtIndex(source, 0, type) == nil, "no depth")
  }
  try write(image, source)
}

private func write(_ image: CGImage, _ source: CGImageSource) throws {
  let quality = [kCGImageDestinationLossyCompressionQuality: 0.5] as CFDictionary
  let data: CFMutableData = NSMutableData()
  guard let memory = CGImageDestinationCreateWithData(data, "public.png" as CFString, 1, nil)
  else { return check(false, "PNG can be written") }
  CGImageDestinationAddImage(memory, image, quality)
  check(CGImageDestinationFinalize(memory), "written")
  guard let again = CGImageSourceCreateWithData(data as CFData, nil),
    let copy = CGImageSourceCreateImageAtIndex(again, 0, nil)
  else { return check(false, "what was written can be read") }
  check(copy.dataProvider?.data == image.dataProvider?.data, "PNG is lossless")
  let url = FileManager.default.temporaryDirectory
    .appendingPathComponent("\(ProcessInfo.processInfo.processIdentifier).jpg")
  defer { try? FileManager.default.removeItem(at: url) }
  let file = CGImageDestinationCreateWithURL(url as CFURL, "public.jpeg" as CFString, 1, nil)
  guard let file else { return check(false, "JPEG can be written") }
  CGImageDestinationAddImageFromSource(file, source, 0, quality)
  check(CGImageDestinationFinalize(file), "written")
  check(try !Data(contentsOf: url).isEmpty, "a file")
  let shot = NSMutableData()
  guard let heic = CGImageDestinationCreateWithData(shot, "public.heic" as CFString, 1, nil)
  else { return check(false, "HEIC can be written") }
  CGImageDestinationAddImage(heic, image, quality)
  check(CGImageDestinationFinalize(heic), "HEIC written")
  let read = CGImageSourceCreateWithData(shot as CFData, nil).flatMap(CGImageSourceGetType)
  check(read == "public.heic" as CFString, "HEIC read")
  check(CGImageDestinationCreateWithURL(url, "com.ilm.openexr-image", 1, nil) == nil, "no OpenEXR")
}

/// The property keys equal those in files of other programs.
private func useProperties() {
  let names: [CFString] = [
    kCGImagePropertyDepth, kCGImagePropertyColorModelGray, kCGImagePropertyHasAlpha,
    kCGImagePropertyExifDictionary, kCGImagePropertyTIFFDictionary, kCGImagePropertyGPSDictionary,
    kCGImagePropertyTIFFMake, kCGImagePropertyTIFFModel, kCGImagePropertyTIFFDateTime,
    kCGImagePropertyTIFFSoftware, kCGImagePropertyTIFFOrientation,
    kCGImagePropertyExifExposureTime, kCGImagePropertyExifFNumber,
    kCGImagePropertyExifISOSpeedRatings, kCGImagePropertyExifDateTimeDigitized,
    kCGImagePropertyExifOffsetTimeOriginal, kCGImagePropertyExifSubsecTimeOriginal,
    kCGImagePropertyExifLensMake, kCGImagePropertyExifLensModel,
    kCGImagePropertyExifLensSerialNumber, kCGImagePropertyExifBodySerialNumber,
    kCGImagePropertyExifFocalLength, kCGImagePropertyExifFocalLenIn35mmFilm,
    kCGImagePropertyExifDateTimeOriginal, kCGImagePropertyExifPixelXDimension,
    kCGImagePropertyExifPixelYDimension, kCGImagePropertyGPSLatitude,
    kCGImagePropertyGPSLatitudeRef, kCGImagePropertyGPSLongitude, kCGImagePropertyGPSLongitudeRef,
    kCGImagePropertyGPSAltitude, kCGImagePropertyGPSAltitudeRef,
    kCGImagePropertyGPSDateStamp, kCGImagePropertyGPSTimeStamp, kCGImagePropertyGPSImgDirection,
    kCGImagePropertyGPSImgDirectionRef, kCGImagePropertyDPIWidth, kCGImagePropertyDPIHeight,
    kCGImagePropertyProfileName, kCGImagePropertyMakerAppleDictionary,
    kCGImagePropertyTIFFArtist, kCGImagePropertyTIFFCopyright,
    kCGImagePropertyExifApertureValue, kCGImagePropertyExifBrightnessValue,
    kCGImagePropertyExifColorSpace, kCGImagePropertyExifDigitalZoomRatio,
    kCGImagePropertyExifExposureBiasValue, kCGImagePropertyExifExposureMode,
    kCGImagePropertyExifExposureProgram, kCGImagePropertyExifFlash,
    kCGImagePropertyExifLightSource, kCGImagePropertyExifMaxApertureValue,
    kCGImagePropertyExifMeteringMode, kCGImagePropertyExifSceneCaptureType,
    kCGImagePropertyExifShutterSpeedValue, kCGImagePropertyExifSubjectDistance,
    kCGImagePropertyExifUserComment, kCGImagePropertyExifWhiteBalance,
  ]
  check(names.allSatisfy { !$0.isEmpty } && names[3] == "{Exif}", "names")
  let numbers = [NSNumber(value: 1.5) as CFNumber] as CFArray
  check(
    numbers[0] as? CGFloat == 1.5 && numbers[0] as? Double == 1.5, "numbers are cast to any type")
}

private func context(_ width: Int, _ height: Int, _ info: UInt32) -> CGContext {
  let context = CGContext(
    data: nil, width: width, height: height, bitsPerComponent: 8, bytesPerRow: 0,
    space: CGColorSpaceCreateDeviceRGB(), bitmapInfo: info)
  guard let context else {
    check(false, "a context")
    exit(1)
  }
  return context
}

private func pixel(_ context: CGContext, _ x: Int, _ y: Int) -> [UInt8] {
  guard let data = context.data else { return [] }
  let size = context.bitsPerPixel / 8
  let start = data + y * context.bytesPerRow + x * size
  return Array(UnsafeRawBufferPointer(start: start, count: size))
}

private func useBitmaps() {
  let blueFirst =
    CGImageAlphaInfo.premultipliedFirst.rawValue | CGBitmapInfo.byteOrder32Little.rawValue
  let drawing = context(4, 4, blueFirst)
  check(drawing.width == 4 && drawing.height == 4 && drawing.bitsPerComponent == 8, "size")
  check(drawing.alphaInfo == .premultipliedFirst && drawing.colorSpace?.name == nil, "layout")
  check(drawing.bitmapInfo.intersection(.alphaInfoMask).rawValue == 2, "alpha first")
  drawing.interpolationQuality = CGInterpolationQuality.none
  drawing.setFillColor(red: 1, green: 0, blue: 0, alpha: 1)
  // One pixel at the top left: y points up, rows go down.
  drawing.fill(CGRect(x: 0, y: 3, width: 1, height: 1))
  check(pixel(drawing, 0, 0) == [0, 0, 255, 255] && pixel(drawing, 0, 3) == [0, 0, 0, 0], "up")
  guard let image = drawing.makeImage(), let copy = image.copy(),
    let corner = image.cropping(to: CGRect(x: 0, y: 0, width: 1, height: 1))
  else { return check(false, "an image") }
  check(copy.alphaInfo == .last && copy.bitsPerComponent == 8 && copy.bitsPerPixel == 32, "pixels")
  check(copy.bytesPerRow == 16 && copy.bitmapInfo.rawValue == copy.alphaInfo.rawValue, "rows")
  check(copy.colorSpace?.numberOfComponents == 3 && corner.width == 1, "colors")
  check(corner.dataProvider?.data == Data([255, 0, 0, 255]) as CFData, "the corner is red")
  draw(image, blueFirst)
  let half = context(2, 1, CGImageAlphaInfo.noneSkipLast.rawValue)
  half.setFillColor(CGColor.white)
  half.fill([CGRect(x: 0, y: 0, width: 2, height: 1)])
  half.setAlpha(0.5)
  half.setFillColor(gray: 0, alpha: 1)
  half.clip(to: CGRect(x: 0, y: 0, width: 1, height: 1))
  half.fill(CGRect(x: 0, y: 0, width: 2, height: 1))
  check((127...129).contains(pixel(half, 0, 0)[0]) && pixel(half, 1, 0)[0] == 255, "mixed")
  half.flush()
  let provider = CGDataProvider(data: Data([0, 255]) as CFData)
  let mask = provider.flatMap {
    CGImage(
      width: 2, height: 1, bitsPerComponent: 8, bitsPerPixel: 8, bytesPerRow: 2,
      space: CGColorSpaceCreateDeviceGray(), bitmapInfo: CGBitmapInfo.byteOrderDefault,
      provider: $0, decode: nil, shouldInterpolate: false,
      intent: CGColorRenderingIntent.defaultIntent)
  }
  check(mask?.bitsPerPixel == 8 && mask?.alphaInfo == CGImageAlphaInfo.none, "gray")
}

/// The red corner follows the transforms.
private func draw(_ image: CGImage, _ info: UInt32) {
  let turned = context(4, 4, info)
  turned.saveGState()
  turned.translateBy(x: 4, y: 0)
  turned.rotate(by: .pi / 2)
  check(!turned.ctm.isIdentity, "a transform")
  turned.draw(image, in: CGRect(x: 0, y: 0, width: 4, height: 4))
  check(pixel(turned, 0, 3) == [0, 0, 255, 255], "a quarter turn counterclockwise")
  turned.restoreGState()
  check(turned.ctm.isIdentity, "as before")
  turned.clear(CGRect(x: 0, y: 0, width: 4, height: 4))
  check(pixel(turned, 0, 3) == [0, 0, 0, 0], "cleared")
  turned.scaleBy(x: 1, y: -1)
  turned.concatenate(CGAffineTransform(translationX: 0, y: -4))
  turned.draw(image, in: CGRect(x: 0, y: 0, width: 4, height: 4))
  check(pixel(turned, 0, 3) == [0, 0, 255, 255], "upside down")
  let disc = context(9, 9, info)
  disc.fillEllipse(in: CGRect(x: 0, y: 0, width: 9, height: 9))
  check(pixel(disc, 4, 4)[3] == 255 && pixel(disc, 0, 0)[3] == 0, "round")
}

private func useColors() {
  let names = [
    CGColorSpace.sRGB, CGColorSpace.linearSRGB, CGColorSpace.extendedSRGB, CGColorSpace.displayP3,
    CGColorSpace.genericRGBLinear, CGColorSpace.adobeRGB1998,
  ]
  let grays = [
    CGColorSpace.genericGrayGamma2_2, CGColorSpace.linearGray, CGColorSpace.extendedGray,
  ]
  check(names.allSatisfy { CGColorSpace(name: $0)?.model == CGColorSpaceModel.rgb }, "colors")
  check(grays.allSatisfy { CGColorSpace(name: $0)?.model == .monochrome }, "grays")
  check(CGColor.black != CGColor.white && CGColor.clear.alpha == 0, "colors are distinct")
  let red = CGColor(srgbRed: 1, green: 0, blue: 0, alpha: 0.5)
  check(red == CGColor(red: 1, green: 0, blue: 0, alpha: 0.5), "the space of all colors")
  check(red.components == [1, 0, 0, 0.5] && red.colorSpace?.model == .rgb, "components")
  let orders: CGBitmapInfo = [.byteOrder16Little, .byteOrder16Big, .byteOrder32Big]
  check(CGBitmapInfo.byteOrderMask.isSuperset(of: orders), "orders")
  let floats = CGContext(
    data: nil, width: 1, height: 1, bitsPerComponent: 32, bytesPerRow: 16,
    space: CGColorSpaceCreateDeviceRGB(), bitmapInfo: CGBitmapInfo.floatComponents.rawValue)
  check(floats == nil, "8 bits only")
}

private func useTransforms() {
  let turn = CGAffineTransform(rotationAngle: .pi / 2)
  let point = CGPoint(x: 1, y: 0).applying(turn)
  check(abs(point.x) < 1e-9 && abs(point.y - 1) < 1e-9, "from x to y")
  let all = CGAffineTransform.identity.translatedBy(x: 1, y: 2).scaledBy(x: 2, y: 2).rotated(by: 1)
  let back = all.concatenating(all.inverted())
  check(abs(back.a - 1) + abs(back.b) + abs(back.c) + abs(back.d - 1) < 1e-9, "and back")
  check(abs(back.tx) + abs(back.ty) < 1e-9, "to the same place")
  check(abs(CGSize(width: 1, height: 2).applying(turn).height - 1) < 1e-9, "a size")
  let box = CGRect(x: 0, y: 0, width: 2, height: 1).applying(turn)
  check(abs(box.height - 2) < 1e-9, "a box")
}
