import CoreMotion
import CoreVideo
import Foundation
import ImageIO
import RealityKit

/// Uses buffers and samples.
func useSamples(_ photo: URL) async throws {
  let loaded: PhotogrammetrySample = try await PhotogrammetrySample(contentsOf: photo)
  let load: () throws -> PhotogrammetrySample = { try PhotogrammetrySample(contentsOf: photo) }
  check(try load().id == loaded.id && loaded.description.contains("\(loaded.id)"), "loaded")
  check(loaded.orientation == CGImagePropertyOrientation.up, "upright")
  let known: [Any?] = [
    loaded.captureTime, loaded.boundingBox, loaded.depthConfidenceMap, loaded.sessionID,
    loaded.scanPassID,
  ]
  check(known.allSatisfy { $0 == nil }, "a rendered photo has no metadata")
  check(describe(loaded.camera) == 0, "no camera")
  var sample = PhotogrammetrySample(id: 7, image: try copy(of: loaded.image))
  sample.metadata = loaded.metadata
  sample.depthDataMap = try buffer(4, 4, kCVPixelFormatType_DisparityFloat32)
  sample.objectMask = try buffer(4, 4, kCVPixelFormatType_OneComponent8)
  var gravity = CMAcceleration()
  gravity.y = -1
  sample.gravity = gravity
  check(sample.gravity?.x == 0 && sample.gravity?.z == 0, "gravity points down")
  check(sample.image != loaded.image && sample.image == sample.image, "buffers have identity")
}

private func describe(_ camera: PhotogrammetrySample.Camera?) -> Int {
  guard let camera else { return 0 }
  let places = [camera.intrinsics.columns.2.x, camera.transform.columns.3.x]
  guard let data: AVCameraCalibrationData = camera.calibrationData else {
    return Int(camera.id) + places.count
  }
  let tables = [data.lensDistortionLookupTable, data.inverseLensDistortionLookupTable]
  print(
    data.intrinsicMatrix, data.intrinsicMatrixReferenceDimensions, data.extrinsicMatrix,
    data.pixelSize, data.lensDistortionCenter, tables)
  return places.count
}

private struct NoBuffer: Error {
  var code: CVReturn
}

private func buffer(_ width: Int, _ height: Int, _ format: OSType) throws -> CVPixelBuffer {
  let attributes =
    [
      kCVPixelBufferCGImageCompatibilityKey: kCFBooleanTrue!,
      kCVPixelBufferCGBitmapContextCompatibilityKey: kCFBooleanFalse!,
      kCVPixelBufferMetalCompatibilityKey: kCFBooleanTrue!,
    ] as CFDictionary
  check(attributes.count == 3, "attributes")
  var buffer: CVPixelBuffer?
  let status = CVPixelBufferCreate(
    kCFAllocatorDefault, width, height, format, attributes, &buffer)
  guard status == kCVReturnSuccess, let buffer else { throw NoBuffer(code: status) }
  check(status != kCVReturnInvalidArgument && status != kCVReturnInvalidPixelFormat, "status")
  return buffer
}

/// The same pixels in another buffer.
private func copy(of image: CVImageBuffer) throws -> CVPixelBuffer {
  let (width, height) = (CVPixelBufferGetWidth(image), CVPixelBufferGetHeight(image))
  let bytesPerRow = CVPixelBufferGetBytesPerRow(image)
  check(CVPixelBufferGetPixelFormatType(image) == kCVPixelFormatType_32BGRA, "BGRA")
  check(CVPixelBufferGetDataSize(image) >= bytesPerRow * height, "size")
  check(!CVPixelBufferIsPlanar(image) && CVPixelBufferGetPlaneCount(image) == 0, "one plane")
  CVPixelBufferLockBaseAddress(image, .readOnly)
  defer { CVPixelBufferUnlockBaseAddress(image, CVPixelBufferLockFlags(rawValue: 1)) }
  guard let base = CVPixelBufferGetBaseAddress(image) else { throw NoBuffer(code: 1) }
  var result: CVPixelBuffer?
  let release: CVPixelBufferReleaseBytesCallback = { _, _ in }
  CVPixelBufferCreateWithBytes(
    nil, width, height, kCVPixelFormatType_32BGRA, base, bytesPerRow, release, nil, nil, &result)
  guard let result else { throw NoBuffer(code: 2) }
  let formats = [
    kCVPixelFormatType_32ARGB, kCVPixelFormatType_32RGBA, kCVPixelFormatType_24RGB,
    kCVPixelFormatType_OneComponent32Float, kCVPixelFormatType_DepthFloat32,
    kCVPixelFormatType_DepthFloat16, kCVPixelFormatType_DisparityFloat16,
    kCVPixelFormatType_OneComponent16Half, kCVPixelFormatType_32ABGR,
    kCVPixelFormatType_420YpCbCr8BiPlanarFullRange,
    kCVPixelFormatType_420YpCbCr8BiPlanarVideoRange,
  ]
  let keys = [
    kCVPixelBufferPixelFormatTypeKey, kCVPixelBufferWidthKey, kCVPixelBufferHeightKey,
    kCVPixelBufferBytesPerRowAlignmentKey, kCVPixelBufferIOSurfacePropertiesKey,
  ]
  let (name, yes, same): (CFString, CFBoolean, CVBuffer) = (keys[0], kCFBooleanTrue, result)
  check(name == kCVPixelBufferPixelFormatTypeKey && yes && same == result, "Core Foundation")
  let time: CFAbsoluteTime = CFAbsoluteTimeGetCurrent()
  let span: CFTimeInterval = autoreleasepool { CFAbsoluteTimeGetCurrent() - time }
  check(span >= 0, "time advances")
  check(Set(formats).count == 11 && Set(keys as [String]).count == 5, "codes")
  let orientations: [CGImagePropertyOrientation] = [
    .up, .upMirrored, .down, .downMirrored, .leftMirrored, .right, .rightMirrored, .left,
  ]
  check(orientations.map(\.rawValue) == Array(1...8), "orientations")
  return result
}

/// Uses the buffers of a pool.
func usePool() throws {
  let attributes: [String: Any] = [
    kCVPixelBufferPixelFormatTypeKey as String: kCVPixelFormatType_32BGRA,
    kCVPixelBufferWidthKey as String: 6, kCVPixelBufferHeightKey as String: 4,
  ]
  let keeping = [
    kCVPixelBufferPoolMinimumBufferCountKey: 2, kCVPixelBufferPoolMaximumBufferAgeKey: 1,
  ]
  var pool: CVPixelBufferPool?
  CVPixelBufferPoolCreate(
    kCFAllocatorSystemDefault, keeping as CFDictionary, attributes as CFDictionary, &pool)
  guard let pool else { throw NoBuffer(code: 3) }
  var (first, second): (CVPixelBuffer?, CVPixelBuffer?)
  let codes = [
    CVPixelBufferPoolCreatePixelBuffer(nil, pool, &first),
    CVPixelBufferPoolCreatePixelBuffer(nil, pool, &second),
  ]
  guard codes == [kCVReturnSuccess, kCVReturnSuccess], let first, let second else {
    throw NoBuffer(code: 4)
  }
  check(first != second && CVImageBufferGetEncodedSize(first).width == 6, "two buffers")
  check(CVImageBufferGetDisplaySize(second).height == 4, "size")
  memset(CVPixelBufferGetBaseAddress(first), 7, CVPixelBufferGetDataSize(first))
  memcpy(CVPixelBufferGetBaseAddress(second), CVPixelBufferGetBaseAddress(first), 24)
  let byte = CVPixelBufferGetBaseAddress(second)?.load(fromByteOffset: 23, as: UInt8.self)
  check(byte == 7, "copied")
  check(CVPixelBufferGetBaseAddressOfPlane(first, 0) == nil, "no planes")
  check(CVPixelBufferGetBytesPerRowOfPlane(first, 0) == 0, "no rows")
  check(CVPixelBufferGetWidthOfPlane(first, 0) + CVPixelBufferGetHeightOfPlane(first, 0) == 0, "")
}
