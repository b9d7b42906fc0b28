import Foundation
import ImageFiles
import ImageIO
import SceneModel
import TestSupport
import Testing

@Suite struct CGImageSourceTests {
  private func source(_ bytes: [UInt8]) throws -> CGImageSource {
    try #require(CGImageSourceCreateWithData(Data(bytes), nil))
  }

  private func jpeg(
    width: Int = 32, height: Int = 16, channels: Int = 3, _ fields: ExifFields? = nil
  ) throws -> [UInt8] {
    let raster = RasterImage(width: width, height: height, channels: channels, filledWith: 90)
    let bytes = try ImageCodec.encodeJPEG(raster, quality: 0.9)
    return fields.map { ExifWriter.jpeg(bytes, with: $0) } ?? bytes
  }

  private func properties(_ bytes: [UInt8]) throws -> [String: Any] {
    try #require(CGImageSourceCopyPropertiesAtIndex(try source(bytes), 0, nil))
  }

  @Test func pixelsAreReadAsStored() throws {
    let raster = RasterImage(
      width: 2, height: 2, channels: 3, pixels: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12])
    let png = try ImageCodec.encodePNG(raster)
    let source = try source(png)
    #expect(CGImageSourceGetType(source) == "public.png")
    #expect(CGImageSourceGetCount(source) == 1 && CGImageSourceGetPrimaryImageIndex(source) == 0)
    #expect(CGImageSourceGetStatus(source) == .statusComplete)
    #expect(CGImageSourceCreateImageAtIndex(source, 0, nil)?.raster == raster)
    let file = try #require(CGImageSourceCopyProperties(source, nil))
    #expect((file[kCGImagePropertyFileSize] as? NSNumber)?.intValue == png.count)
  }

  @Test func otherIndicesHaveNothing() throws {
    let source = try source(jpeg())
    for index in [-1, 1] {
      #expect(CGImageSourceCreateImageAtIndex(source, index, nil) == nil)
      #expect(CGImageSourceCopyPropertiesAtIndex(source, index, nil) == nil)
      #expect(CGImageSourceCreateThumbnailAtIndex(source, index, nil) == nil)
    }
    #expect(
      CGImageSourceCopyAuxiliaryDataInfoAtIndex(source, 0, kCGImageAuxiliaryDataTypeDepth) == nil)
  }

  @Test(arguments: ["", "plain text", "\u{89}PNG\r\n"]) func otherFilesHaveNoImages(
    text: String
  ) throws {
    let source = try source(Array(text.utf8))
    #expect(CGImageSourceGetCount(source) == 0 && CGImageSourceGetType(source) == nil)
    #expect(CGImageSourceGetStatus(source) == .statusUnknownType)
    #expect(CGImageSourceCreateImageAtIndex(source, 0, nil) == nil)
    #expect(CGImageSourceCopyPropertiesAtIndex(source, 0, nil) == nil)
    #expect(CGImageSourceCreateThumbnailAtIndex(source, 0, nil) == nil)
  }

  @Test func missingFilesGiveNoSource() {
    #expect(CGImageSourceCreateWithURL(URL(fileURLWithPath: "/missing.jpg"), nil) == nil)
  }

  @Test func damagedPixelsGiveNoImage() throws {
    let source = try source(Array(try jpeg(width: 256, height: 256).prefix(200)))
    #expect(CGImageSourceCreateImageAtIndex(source, 0, nil) == nil)
  }

  @Test func cameraPropertiesHaveTheirNames() throws {
    var fields = ExifFields()
    fields.orientation = 8
    fields.make = "Maker"
    fields.model = "Model 7"
    fields.focalLength = (414, 10)
    fields.focalLengthIn35mmFilm = 41
    fields.originalSize = (4000, 3000)
    fields.position = (-33.8568, 151.2153, -12.5)
    let properties = try properties(jpeg(fields))
    func number(_ key: String, in directory: [String: Any]? = nil) -> Double? {
      ((directory ?? properties)[key] as? NSNumber)?.doubleValue
    }
    #expect(number(kCGImagePropertyPixelWidth) == 32 && number(kCGImagePropertyPixelHeight) == 16)
    #expect(number(kCGImagePropertyOrientation) == 8 && number(kCGImagePropertyDepth) == 8)
    #expect(properties[kCGImagePropertyColorModel] as? String == "RGB")
    #expect(properties[kCGImagePropertyHasAlpha] == nil)
    let tiff = try #require(properties["{TIFF}"] as? [String: Any])
    #expect(tiff["Make"] as? String == "Maker" && tiff["Model"] as? String == "Model 7")
    #expect(number("Orientation", in: tiff) == 8 && tiff["Software"] == nil)
    let exif = try #require(properties["{Exif}"] as? [String: Any])
    #expect(number("FocalLength", in: exif) == 41.4)
    #expect(number("FocalLenIn35mmFilm", in: exif) == 41)
    #expect(number("PixelXDimension", in: exif) == 4000)
    #expect(number("PixelYDimension", in: exif) == 3000 && exif["LensModel"] == nil)
    let gps = try #require(properties["{GPS}"] as? [String: Any])
    #expect(abs(try #require(number("Latitude", in: gps)) - 33.8568) < 1e-6)
    #expect(abs(try #require(number("Longitude", in: gps)) - 151.2153) < 1e-6)
    #expect(gps["LatitudeRef"] as? String == "S" && gps["LongitudeRef"] as? String == "E")
    #expect(number("Altitude", in: gps) == 12.5 && number("AltitudeRef", in: gps) == 1)
  }

  @Test func photosWithoutMetadataAreUpright() throws {
    let properties = try properties(jpeg())
    #expect((properties[kCGImagePropertyOrientation] as? NSNumber)?.intValue == 1)
    #expect(properties[kCGImagePropertyGPSDictionary] == nil)
    #expect((properties[kCGImagePropertyExifDictionary] as? [String: Any])?.isEmpty == true)
  }

  @Test(
    arguments: [
      (1, "Gray", nil), (3, "RGB", nil), (4, "RGB", true),
    ] as [(Int, String, Bool?)]) func colorModelsAreThoseOfTheFile(
      channels: Int, model: String, hasAlpha: Bool?
    ) throws
  {
    let raster = RasterImage(width: 2, height: 2, channels: channels, filledWith: 9)
    let png = try ImageCodec.encodePNG(raster)
    let properties = try properties(png)
    #expect(properties[kCGImagePropertyColorModel] as? String == model)
    #expect(properties[kCGImagePropertyHasAlpha] as? Bool == hasAlpha)
    let image = try #require(CGImageSourceCreateImageAtIndex(try source(png), 0, nil))
    #expect(image.raster == raster)
  }

  @Test func grayPhotosAreGray() throws {
    let image = try #require(
      CGImageSourceCreateImageAtIndex(try source(jpeg(channels: 1)), 0, nil))
    #expect(image.bitsPerPixel == 8 && image.raster.channels == 1)
    let properties = try properties(jpeg(channels: 1))
    #expect(properties[kCGImagePropertyColorModel] as? String == kCGImagePropertyColorModelGray)
  }

  @Test(arguments: [
    (64, 32, 16), (32, 32, 16), (16, 16, 8), (10, 10, 5), (3, 3, 2), (1, 1, 1), (0, 32, 16),
  ]) func thumbnailsFitTheirSide(side: Int, width: Int, height: Int) throws {
    let options: [String: Any] = [kCGImageSourceThumbnailMaxPixelSize: side]
    let small = try #require(CGImageSourceCreateThumbnailAtIndex(try source(jpeg()), 0, options))
    #expect((small.width, small.height) == (width, height))
  }

  @Test func thumbnailsAreTurnedOnRequest() throws {
    var fields = ExifFields()
    fields.orientation = 6
    let source = try source(jpeg(fields))
    func size(_ isTurned: Bool) throws -> [Int] {
      let options: [String: Any] = [
        kCGImageSourceThumbnailMaxPixelSize: 8,
        kCGImageSourceCreateThumbnailWithTransform: isTurned,
      ]
      let small = try #require(CGImageSourceCreateThumbnailAtIndex(source, 0, options))
      return [small.width, small.height]
    }
    #expect(try size(false) == [8, 4])
    #expect(try size(true) == [4, 8])
    #expect(try #require(CGImageSourceCreateImageAtIndex(source, 0, nil)).width == 32)
  }

  @Test func providersOfTheRightTypeBecomeImages() throws {
    let raster = RasterImage(width: 2, height: 1, channels: 3, filledWith: 8)
    let png = try #require(CGDataProvider(data: Data(try ImageCodec.encodePNG(raster))))
    let jpeg = try #require(CGDataProvider(data: Data(try jpeg())))
    func readPNG(_ provider: CGDataProvider) -> CGImage? {
      CGImage(
        pngDataProviderSource: provider, decode: nil, shouldInterpolate: false,
        intent: .defaultIntent)
    }
    func readJPEG(_ provider: CGDataProvider) -> CGImage? {
      CGImage(
        jpegDataProviderSource: provider, decode: nil, shouldInterpolate: true,
        intent: .perceptual)
    }
    #expect(readPNG(png)?.raster == raster && readPNG(jpeg) == nil)
    #expect(readJPEG(jpeg)?.width == 32 && readJPEG(png) == nil)
  }

  @Test func orientationsAreThoseOfEXIF() {
    let all: [CGImagePropertyOrientation] = [
      .up, .upMirrored, .down, .downMirrored, .leftMirrored, .right, .rightMirrored, .left,
    ]
    #expect(all.map(\.rawValue) == [1, 2, 3, 4, 5, 6, 7, 8])
    #expect(CGImagePropertyOrientation(rawValue: 0) == nil)
    #expect(CGImageSourceStatus.statusUnexpectedEOF.rawValue == -5)
    #expect(CGImageSourceStatus.statusComplete.rawValue == 0)
  }
}
