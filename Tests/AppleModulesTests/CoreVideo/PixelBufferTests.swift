import CoreVideo
import SceneModel
import Testing

@Suite struct PixelBufferTests {
  private func buffer(
    _ width: Int, _ height: Int, _ format: OSType = kCVPixelFormatType_32BGRA
  ) throws -> CVPixelBuffer {
    var buffer: CVPixelBuffer?
    let status = CVPixelBufferCreate(kCFAllocatorDefault, width, height, format, nil, &buffer)
    #expect(status == kCVReturnSuccess)
    return try #require(buffer)
  }

  private func bytes(of buffer: CVPixelBuffer) throws -> [UInt8] {
    let base = try #require(CVPixelBufferGetBaseAddress(buffer))
    return Array(UnsafeRawBufferPointer(start: base, count: CVPixelBufferGetDataSize(buffer)))
  }

  @Test(arguments: [
    (kCVPixelFormatType_32BGRA, 17, 128), (kCVPixelFormatType_32ARGB, 16, 64),
    (kCVPixelFormatType_32RGBA, 1, 64), (kCVPixelFormatType_24RGB, 22, 128),
    (kCVPixelFormatType_OneComponent8, 65, 128), (kCVPixelFormatType_OneComponent8, 64, 64),
    (kCVPixelFormatType_OneComponent16Half, 33, 128), (kCVPixelFormatType_DepthFloat16, 32, 64),
    (kCVPixelFormatType_DisparityFloat16, 32, 64), (kCVPixelFormatType_DepthFloat32, 20, 128),
    (kCVPixelFormatType_DisparityFloat32, 16, 64),
    (kCVPixelFormatType_OneComponent32Float, 48, 192),
  ]) func rowsAreAMultipleOf64Bytes(format: OSType, width: Int, bytesPerRow: Int) throws {
    let buffer = try buffer(width, 3, format)
    #expect(CVPixelBufferGetBytesPerRow(buffer) == bytesPerRow)
    #expect(CVPixelBufferGetDataSize(buffer) == 3 * bytesPerRow)
    #expect(CVPixelBufferGetWidth(buffer) == width && CVPixelBufferGetHeight(buffer) == 3)
    #expect(CVPixelBufferGetPixelFormatType(buffer) == format)
    #expect(try bytes(of: buffer) == [UInt8](repeating: 0, count: 3 * bytesPerRow))
  }

  @Test(arguments: [(0, 4), (4, 0), (-1, 4), (65537, 1), (1, 65537)])
  func invalidSizesAreRefused(width: Int, height: Int) throws {
    var result: CVPixelBuffer? = try buffer(1, 1)
    let status = CVPixelBufferCreate(nil, width, height, kCVPixelFormatType_32BGRA, nil, &result)
    #expect(status == kCVReturnInvalidArgument && status == -6661 && result == nil)
  }

  @Test(arguments: [
    kCVPixelFormatType_420YpCbCr8BiPlanarFullRange, kCVPixelFormatType_32ABGR, 0,
  ]) func unsupportedFormatsAreRefused(format: OSType) throws {
    var result: CVPixelBuffer? = try buffer(1, 1)
    let status = CVPixelBufferCreate(nil, 4, 4, format, nil, &result)
    #expect(status == kCVReturnInvalidPixelFormat && status == -6680 && result == nil)
  }

  @Test func formatCodesAreApplesFourCharacters() {
    func code(_ text: String) -> OSType { text.utf8.reduce(0) { $0 << 8 | OSType($1) } }
    #expect(kCVPixelFormatType_32BGRA == code("BGRA") && kCVPixelFormatType_32RGBA == code("RGBA"))
    #expect(kCVPixelFormatType_32ABGR == code("ABGR") && kCVPixelFormatType_32ARGB == 32)
    #expect(kCVPixelFormatType_24RGB == 24 && kCVPixelFormatType_OneComponent8 == code("L008"))
    #expect(kCVPixelFormatType_OneComponent16Half == code("L00h"))
    #expect(kCVPixelFormatType_OneComponent32Float == code("L00f"))
    #expect(kCVPixelFormatType_DepthFloat32 == code("fdep"))
    #expect(kCVPixelFormatType_DepthFloat16 == code("hdep"))
    #expect(kCVPixelFormatType_DisparityFloat32 == code("fdis"))
    #expect(kCVPixelFormatType_DisparityFloat16 == code("hdis"))
    #expect(kCVPixelFormatType_420YpCbCr8BiPlanarVideoRange == code("420v"))
    #expect(kCVPixelFormatType_420YpCbCr8BiPlanarFullRange == code("420f"))
  }

  @Test func bytesAreCopiedRowByRowAndReleased() throws {
    // Two rows of two RGB pixels, eight bytes apart.
    var source: [UInt8] = [1, 2, 3, 4, 5, 6, 99, 99, 7, 8, 9, 10, 11, 12]
    var released = false
    var result: CVPixelBuffer?
    let status = withUnsafeMutablePointer(to: &released) { flag in
      source.withUnsafeMutableBytes { bytes in
        CVPixelBufferCreateWithBytes(
          nil, 2, 2, kCVPixelFormatType_24RGB, bytes.baseAddress!, 8,
          { context, _ in context?.assumingMemoryBound(to: Bool.self).pointee = true }, flag, nil,
          &result)
      }
    }
    #expect(status == kCVReturnSuccess && released)
    let buffer = try #require(result)
    source = []
    let bytes = try bytes(of: buffer)
    #expect(Array(bytes[0..<7]) == [1, 2, 3, 4, 5, 6, 0])
    #expect(Array(bytes[64..<71]) == [7, 8, 9, 10, 11, 12, 0])
    #expect(buffer.image?.pixels == [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12])
  }

  @Test func rowsShorterThanTheirPixelsAreRefused() throws {
    var released = false
    var source = [UInt8](repeating: 0, count: 64)
    var result: CVPixelBuffer? = try buffer(1, 1)
    let status = withUnsafeMutablePointer(to: &released) { flag in
      source.withUnsafeMutableBytes { bytes in
        CVPixelBufferCreateWithBytes(
          nil, 4, 4, kCVPixelFormatType_32BGRA, bytes.baseAddress!, 15,
          { context, _ in context?.assumingMemoryBound(to: Bool.self).pointee = true }, flag, nil,
          &result)
      }
    }
    #expect(status == kCVReturnInvalidArgument && result == nil && !released)
  }

  @Test(
    arguments: [
      (kCVPixelFormatType_32BGRA, [3, 2, 1, 0]), (kCVPixelFormatType_32ARGB, [0, 1, 2, 3]),
      (kCVPixelFormatType_32RGBA, [1, 2, 3, 0]), (kCVPixelFormatType_24RGB, [1, 2, 3]),
    ] as [(OSType, [UInt8])]) func colorsAreReadInOrder(format: OSType, pixel: [UInt8]) throws
  {
    let buffer = try buffer(2, 2, format)
    let base = try #require(CVPixelBufferGetBaseAddress(buffer))
    // The bottom right pixel.
    memcpy(base + CVPixelBufferGetBytesPerRow(buffer) + pixel.count, pixel, pixel.count)
    let image = try #require(buffer.image)
    #expect((image.width, image.height, image.channels) == (2, 2, 3))
    #expect(image.pixels == [0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3])
    #expect(buffer.grayImage == nil)
  }

  @Test func graysAreRead() throws {
    let buffer = try buffer(3, 2, kCVPixelFormatType_OneComponent8)
    let base = try #require(CVPixelBufferGetBaseAddress(buffer))
    memset(base + CVPixelBufferGetBytesPerRow(buffer), 7, 2)
    #expect(buffer.grayImage?.pixels == [0, 0, 0, 7, 7, 0] && buffer.image == nil)
  }

  @Test func imagesBecomeBGRABuffers() throws {
    let image = RasterImage(width: 2, height: 1, channels: 3, pixels: [1, 2, 3, 4, 5, 6])
    let buffer = try #require(CVPixelBuffer(image))
    #expect(CVPixelBufferGetPixelFormatType(buffer) == kCVPixelFormatType_32BGRA)
    #expect(try bytes(of: buffer).prefix(9) == [3, 2, 1, 255, 6, 5, 4, 255, 0])
    #expect(buffer.image == image)
    #expect(CVPixelBuffer(RasterImage(width: 1, height: 1, channels: 1)) == nil)
  }

  @Test func buffersHaveNoPlanes() throws {
    let buffer = try buffer(4, 4)
    #expect(!CVPixelBufferIsPlanar(buffer) && CVPixelBufferGetPlaneCount(buffer) == 0)
    #expect(CVPixelBufferGetBaseAddressOfPlane(buffer, 0) == nil)
    #expect(CVPixelBufferGetBytesPerRowOfPlane(buffer, 0) == 0)
    #expect(CVPixelBufferGetWidthOfPlane(buffer, 0) == 0)
    #expect(CVPixelBufferGetHeightOfPlane(buffer, 0) == 0)
    #expect(CVImageBufferGetEncodedSize(buffer) == CGSize(width: 4, height: 4))
    #expect(CVImageBufferGetDisplaySize(buffer) == CGSize(width: 4, height: 4))
  }

  @Test func lockingSucceedsAndKeepsTheAddress() throws {
    let buffer = try buffer(4, 4)
    let before = CVPixelBufferGetBaseAddress(buffer)
    #expect(CVPixelBufferLockBaseAddress(buffer, .readOnly) == kCVReturnSuccess)
    #expect(CVPixelBufferGetBaseAddress(buffer) == before)
    #expect(CVPixelBufferUnlockBaseAddress(buffer, .readOnly) == kCVReturnSuccess)
    #expect(CVPixelBufferLockFlags.readOnly.rawValue == 1)
  }

  @Test func equalityIsIdentity() throws {
    let (a, b) = (try buffer(1, 1), try buffer(1, 1))
    #expect(a == a && a != b && Set([a, b, a]).count == 2)
  }

  @Test func memoryFunctionsAcceptMissingAddresses() {
    let missing: UnsafeMutableRawPointer? = nil
    #expect(memset(missing, 1, 4) == nil && memcpy(missing, [1], 1) == nil)
    var bytes: [UInt8] = [1, 2]
    let unchanged = bytes.withUnsafeMutableBytes { memcpy($0.baseAddress, nil, 2) != nil }
    #expect(unchanged && bytes == [1, 2])
  }
}

@Suite struct PixelBufferPoolTests {
  private let attributes: CFDictionary = [
    kCVPixelBufferWidthKey: 5, kCVPixelBufferHeightKey: 7,
    kCVPixelBufferPixelFormatTypeKey: kCVPixelFormatType_OneComponent8,
  ]

  @Test func buffersHaveTheAttributesAndAreDistinct() throws {
    var result: CVPixelBufferPool?
    let options = [kCVPixelBufferPoolMinimumBufferCountKey: 2]
    #expect(CVPixelBufferPoolCreate(nil, options, attributes, &result) == kCVReturnSuccess)
    let pool = try #require(result)
    var buffers: [CVPixelBuffer?] = [nil, nil]
    for index in buffers.indices {
      #expect(CVPixelBufferPoolCreatePixelBuffer(nil, pool, &buffers[index]) == kCVReturnSuccess)
    }
    let (first, second) = (try #require(buffers[0]), try #require(buffers[1]))
    #expect(first != second)
    #expect(CVPixelBufferGetBaseAddress(first) != CVPixelBufferGetBaseAddress(second))
    #expect(CVPixelBufferGetWidth(second) == 5 && CVPixelBufferGetHeight(second) == 7)
    #expect(CVPixelBufferGetPixelFormatType(second) == kCVPixelFormatType_OneComponent8)
  }

  @Test func aListOfFormatsStandsForItsFirst() throws {
    var listed = attributes
    listed[kCVPixelBufferPixelFormatTypeKey] = [
      NSNumber(value: kCVPixelFormatType_32ARGB), NSNumber(value: kCVPixelFormatType_24RGB),
    ]
    var pool: CVPixelBufferPool?
    #expect(CVPixelBufferPoolCreate(nil, nil, listed, &pool) == kCVReturnSuccess)
    var buffer: CVPixelBuffer?
    CVPixelBufferPoolCreatePixelBuffer(nil, try #require(pool), &buffer)
    #expect(
      CVPixelBufferGetPixelFormatType(try #require(buffer)) == kCVPixelFormatType_32ARGB)
  }

  @Test(arguments: [
    kCVPixelBufferWidthKey, kCVPixelBufferHeightKey, kCVPixelBufferPixelFormatTypeKey,
  ]) func missingAttributesAreRefused(key: String) {
    var incomplete = attributes
    incomplete[key] = nil
    var pool: CVPixelBufferPool?
    #expect(CVPixelBufferPoolCreate(nil, nil, incomplete, &pool) == kCVReturnInvalidArgument)
    #expect(pool == nil)
    #expect(CVPixelBufferPoolCreate(nil, nil, nil, &pool) == kCVReturnInvalidArgument)
  }

  @Test func buffersOfAnInvalidSizeAreRefused() throws {
    var huge = attributes
    huge[kCVPixelBufferWidthKey] = 1 << 20
    var pool: CVPixelBufferPool?
    CVPixelBufferPoolCreate(nil, nil, huge, &pool)
    var buffer: CVPixelBuffer?
    let status = CVPixelBufferPoolCreatePixelBuffer(nil, try #require(pool), &buffer)
    #expect(status == kCVReturnInvalidArgument && buffer == nil)
  }
}
