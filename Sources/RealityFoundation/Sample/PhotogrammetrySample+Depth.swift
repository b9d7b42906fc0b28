import SceneModel

extension PhotogrammetrySample {
  /// The depth map in meters, rotated like the upright photo. Nil if there is no map or it holds
  /// neither depths nor disparities.
  var uprightDepth: DepthMap? {
    guard let map = depthDataMap, let depths = map.depths else { return nil }
    return DepthMap(width: map.width, height: map.height, depths: depths)?
      .turned(byOrientation: Int(storedOrientation.rawValue))
  }
}

extension CVPixelBuffer {
  /// Depths in meters, row by row; nil for pixel formats that are neither depth nor disparity.
  fileprivate var depths: [Float]? {
    switch pixelFormat {
    case kCVPixelFormatType_DepthFloat32: singles
    case kCVPixelFormatType_DisparityFloat32: singles.map { 1 / $0 }
    case kCVPixelFormatType_DepthFloat16: halves
    case kCVPixelFormatType_DisparityFloat16: halves.map { 1 / $0 }
    default: nil
    }
  }

  private var singles: [Float] { rows(of: UInt32.self).map { Float(bitPattern: $0) } }

  private var halves: [Float] { rows(of: UInt16.self).map { Float(Float16(bitPattern: $0)) } }

  private func rows<Pixel: BitwiseCopyable>(of type: Pixel.Type) -> [Pixel] {
    let size = width * MemoryLayout<Pixel>.size
    return (0..<height).flatMap { row in
      storage.copy(row * bytesPerRow..<row * bytesPerRow + size).withUnsafeBytes { bytes in
        (0..<width).map {
          bytes.loadUnaligned(fromByteOffset: $0 * MemoryLayout<Pixel>.size, as: type)
        }
      }
    }
  }
}
