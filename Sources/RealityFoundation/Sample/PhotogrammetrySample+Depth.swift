import ImageIO
import SceneModel

extension PhotogrammetrySample {
  /// The depth map turned as the photo is to be turned, in metres. Nil without one, or where it holds
  /// neither depths nor disparities.
  var uprightDepth: DepthMap? {
    guard let map = depthDataMap, let stored = map.depths else { return nil }
    let (width, height) = (map.width, map.height)
    let swaps = storedOrientation.rawValue >= 5
    let (columns, rows) = swaps ? (height, width) : (width, height)
    var depths: [Float] = []
    depths.reserveCapacity(stored.count)
    for row in 0..<rows {
      for column in 0..<columns {
        let (x, y) =
          switch storedOrientation {
          case .up: (column, row)
          case .upMirrored: (width - 1 - column, row)
          case .down: (width - 1 - column, height - 1 - row)
          case .downMirrored: (column, height - 1 - row)
          case .leftMirrored: (row, column)
          case .right: (row, height - 1 - column)
          case .rightMirrored: (width - 1 - row, height - 1 - column)
          case .left: (width - 1 - row, column)
          }
        depths.append(stored[y * width + x])
      }
    }
    return DepthMap(width: columns, height: rows, depths: depths)
  }
}

extension CVPixelBuffer {
  /// Depths in metres, row by row; nil for formats of neither depths nor disparities.
  fileprivate var depths: [Float]? {
    let isDisparity = [kCVPixelFormatType_DisparityFloat32, kCVPixelFormatType_DisparityFloat16]
      .contains(pixelFormat)
    let values: [Float]
    switch pixelFormat {
    case kCVPixelFormatType_DepthFloat32, kCVPixelFormatType_DisparityFloat32:
      values = rows(of: 4) { Float(bitPattern: $0.load(as: UInt32.self)) }
    case kCVPixelFormatType_DepthFloat16, kCVPixelFormatType_DisparityFloat16:
      values = rows(of: 2) { Float(Float16(bitPattern: $0.load(as: UInt16.self))) }
    default: return nil
    }
    return isDisparity ? values.map { 1 / $0 } : values
  }

  private func rows(
    of size: Int, _ value: (Slice<UnsafeRawBufferPointer>) -> Float
  ) -> [Float] {
    (0..<height).flatMap { row in
      storage.copy(row * bytesPerRow..<row * bytesPerRow + width * size).withUnsafeBytes { bytes in
        (0..<width).map { value(bytes[$0 * size..<($0 + 1) * size]) }
      }
    }
  }
}

extension Slice<UnsafeRawBufferPointer> {
  fileprivate func load<T: BitwiseCopyable>(as type: T.Type) -> T {
    UnsafeRawBufferPointer(rebasing: self).loadUnaligned(as: type)
  }
}
