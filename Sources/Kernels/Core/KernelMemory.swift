import CKernels
import SceneModel

extension Array where Element: BitwiseCopyable {
  /// Calls `body` with the elements as a span, valid only during the call.
  func withSpan<Result>(_ body: (ck_span) throws -> Result) rethrows -> Result {
    try withUnsafeBytes {
      try body(
        ck_span(data: $0.baseAddress, count: count, stride: MemoryLayout<Element>.stride))
    }
  }

  /// Calls `body` with the elements as a writable span, valid only during the call.
  mutating func withMutableSpan<Result>(
    _ body: (ck_mutable_span) throws -> Result
  ) rethrows -> Result {
    let count = count
    return try withUnsafeMutableBytes {
      try body(
        ck_mutable_span(
          data: $0.baseAddress, count: count, stride: MemoryLayout<Element>.stride))
    }
  }
}

/// Calls `body` with the elements of two arrays as spans, valid only during the call.
func withSpans<A: BitwiseCopyable, B: BitwiseCopyable, Result>(
  _ a: [A], _ b: [B], _ body: (ck_span, ck_span) throws -> Result
) rethrows -> Result {
  try a.withSpan { a in try b.withSpan { b in try body(a, b) } }
}

extension Mesh {
  /// Calls `body` with the mesh's positions and triangles, valid only during the call.
  func withKernelValue<Result>(
    _ body: (UnsafePointer<ck_mesh>) throws -> Result
  ) rethrows -> Result {
    try withSpans(positions, triangles) { positions, triangles in
      var mesh = ck_mesh(
        positions: positions, triangles: triangles.data?.assumingMemoryBound(to: UInt32.self),
        triangle_count: triangles.count)
      return try body(&mesh)
    }
  }

  /// Calls `body` with the mesh's positions and triangles to modify, valid only during the call.
  mutating func withMutableKernelValue<Result>(
    _ body: (inout ck_mutable_mesh) throws -> Result
  ) rethrows -> Result {
    try positions.withMutableSpan { positions in
      try triangles.withMutableSpan { triangles in
        var mesh = ck_mutable_mesh(
          positions: positions, triangles: triangles.data?.assumingMemoryBound(to: UInt32.self),
          triangle_count: triangles.count)
        return try body(&mesh)
      }
    }
  }
}

extension RasterImage {
  /// Whether the image is gray and has the size of another one, as the masks of kernels must.
  func isGray(ofTheSizeOf image: RasterImage) -> Bool {
    (width, height, channels) == (image.width, image.height, 1)
  }

  /// Calls `body` with the pixels, valid only during the call.
  package func withKernelPixels<Result>(
    _ body: (UnsafePointer<ck_pixels>) throws -> Result
  ) rethrows -> Result {
    try pixels.withUnsafeBufferPointer { buffer in
      var raw = ck_pixels(
        data: buffer.baseAddress, width: Int32(width), height: Int32(height),
        channels: Int32(channels), row_stride: width * channels)
      return try body(&raw)
    }
  }

  /// Calls `body` with the writable pixels, valid only during the call.
  package mutating func withMutableKernelPixels<Result>(
    _ body: (UnsafePointer<ck_mutable_pixels>) throws -> Result
  ) rethrows -> Result {
    let (width, height, channels) = (Int32(width), Int32(height), Int32(channels))
    return try pixels.withUnsafeMutableBufferPointer { buffer in
      var raw = ck_mutable_pixels(
        data: buffer.baseAddress, width: width, height: height, channels: channels)
      return try body(&raw)
    }
  }
}
