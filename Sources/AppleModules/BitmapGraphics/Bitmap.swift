/// The pixels that a context draws into: memory of its own, or a caller's buffer that outlives it.
struct Bitmap {
  let width: Int
  let height: Int
  let bytesPerRow: Int
  let layout: PixelLayout
  let storage: PixelStorage

  init?(
    data: UnsafeMutableRawPointer?, width: Int, height: Int, bytesPerRow: Int, layout: PixelLayout
  ) {
    let rowSize = width * layout.size
    // 0 leaves the row stride to the context.
    let rowStride = bytesPerRow == 0 ? (rowSize + 63) / 64 * 64 : bytesPerRow
    guard rowStride >= rowSize else { return nil }
    // The last row of a buffer may be shorter than the stride.
    storage =
      data.map { PixelStorage(borrowing: $0, byteCount: rowStride * (height - 1) + rowSize) }
      ?? PixelStorage(byteCount: rowStride * height)
    self.width = width
    self.height = height
    self.bytesPerRow = rowStride
    self.layout = layout
  }

  /// The bytes of a row without its padding.
  func row(_ y: Int) -> ArraySlice<UInt8> { storage.copy(byteRange(0..<width, y))[...] }

  /// The byte range of some pixels of a row.
  private func byteRange(_ columns: Range<Int>, _ y: Int) -> Range<Int> {
    let start = y * bytesPerRow + columns.lowerBound * layout.size
    return start..<start + columns.count * layout.size
  }

  /// Sets the pixels of a rectangle, clipped to the bitmap, to zero.
  func clear(_ columns: Range<Int>, _ rows: Range<Int>) {
    let columns = columns.clamped(to: 0..<width)
    let zeros = [UInt8](repeating: 0, count: columns.count * layout.size)
    for y in rows.clamped(to: 0..<height) {
      storage.write(zeros, at: byteRange(columns, y).lowerBound)
    }
  }

  /// Composites one pixel value for each pixel of a rectangle, clipped to the bitmap, over the
  /// existing ones; nil leaves a pixel unchanged.
  func draw(_ columns: Range<Int>, _ rows: Range<Int>, pixel: (Int, Int) -> PixelValue?) {
    let columns = columns.clamped(to: 0..<width)
    guard !columns.isEmpty else { return }
    for y in rows.clamped(to: 0..<height) {
      let byteRange = byteRange(columns, y)
      var bytes = storage.copy(byteRange)
      var at = 0
      for x in columns {
        if let value = pixel(x, y), value.alpha > 0 { store(value, in: &bytes, at) }
        at += layout.size
      }
      storage.write(bytes, at: byteRange.lowerBound)
    }
  }

  private func store(_ value: PixelValue, in bytes: inout [UInt8], _ at: Int) {
    let sum = value.alpha < 255 ? value.over(existingValue(bytes, at)) : value
    let stored = layout.isPremultiplied ? sum.premultiplied : sum
    if layout.colorOffsets.count == 3 {
      bytes[at + layout.colorOffsets[0]] = stored.red
      bytes[at + layout.colorOffsets[1]] = stored.green
      bytes[at + layout.colorOffsets[2]] = stored.blue
    } else if layout.colorOffsets.count == 1 {
      bytes[at] = stored.gray
    }
    if let alpha = layout.alpha { bytes[at + alpha] = stored.alpha }
    if let unused = layout.unused { bytes[at + unused] = 255 }
  }

  private func existingValue(_ bytes: [UInt8], _ at: Int) -> PixelValue {
    let alpha = layout.alpha.map { bytes[at + $0] } ?? 255
    let value: PixelValue
    switch layout.colorOffsets.count {
    case 0: return PixelValue(0, 0, 0, alpha)
    case 1: value = PixelValue(bytes[at], bytes[at], bytes[at], alpha)
    default:
      value = PixelValue(
        bytes[at + layout.colorOffsets[0]], bytes[at + layout.colorOffsets[1]],
        bytes[at + layout.colorOffsets[2]], alpha)
    }
    return layout.isPremultiplied ? value.unpremultiplied : value
  }
}

/// A color component, premultiplied by alpha, divided by alpha; unchanged if alpha is 0 or 255.
func divided(_ component: UInt8, byAlpha alpha: UInt8) -> UInt8 {
  guard alpha > 0, alpha < 255 else { return component }
  return UInt8(min(255, (Int(component) * 255 + Int(alpha) / 2) / Int(alpha)))
}

extension PixelValue {
  /// The color with its components multiplied by alpha.
  var premultiplied: PixelValue {
    guard alpha < 255 else { return self }
    func scaled(_ value: UInt8) -> UInt8 { UInt8((Int(value) * Int(alpha) + 127) / 255) }
    return PixelValue(scaled(red), scaled(green), scaled(blue), alpha)
  }

  /// The color with its components divided by alpha.
  var unpremultiplied: PixelValue {
    PixelValue(
      divided(red, byAlpha: alpha), divided(green, byAlpha: alpha), divided(blue, byAlpha: alpha),
      alpha)
  }

  /// This color composited over another (source-over; Porter and Duff 1984), neither premultiplied.
  func over(_ other: PixelValue) -> PixelValue {
    // Weights in units of 1/65025, the product of two bytes.
    let (front, back) = (Int(alpha) * 255, Int(other.alpha) * (255 - Int(alpha)))
    let sum = front + back
    guard sum > 0 else { return PixelValue(0, 0, 0, 0) }
    func mixed(_ a: UInt8, _ b: UInt8) -> UInt8 {
      UInt8((Int(a) * front + Int(b) * back + sum / 2) / sum)
    }
    return PixelValue(
      mixed(red, other.red), mixed(green, other.green), mixed(blue, other.blue),
      UInt8((sum + 127) / 255))
  }
}
