import Kernels

/// The pixels that a context draws into: its own, or those of a buffer that outlives it.
struct Bitmap {
  let width: Int
  let height: Int
  let bytesPerRow: Int
  let layout: PixelLayout
  let base: UnsafeMutableRawPointer
  /// Keeps the pixels where the context made them itself.
  private let storage: PixelStorage?

  init?(
    data: UnsafeMutableRawPointer?, width: Int, height: Int, bytesPerRow: Int, layout: PixelLayout
  ) {
    let rowSize = width * layout.size
    // 0 leaves the distance of rows to us.
    let distance = bytesPerRow == 0 ? (rowSize + 63) / 64 * 64 : bytesPerRow
    guard distance >= rowSize else { return nil }
    storage = data == nil ? PixelStorage(byteCount: distance * height) : nil
    guard let base = data ?? storage?.baseAddress else { return nil }
    self.width = width
    self.height = height
    self.bytesPerRow = distance
    self.layout = layout
    self.base = base
  }

  /// The bytes of a row that hold pixels.
  func row(_ y: Int) -> ArraySlice<UInt8> {
    Array(UnsafeRawBufferPointer(start: base + y * bytesPerRow, count: width * layout.size))[...]
  }

  /// Sets the pixels of a rectangle, which is cut off at the rim, to zero.
  func clear(_ columns: Range<Int>, _ rows: Range<Int>) {
    let columns = columns.clamped(to: 0..<width)
    for y in rows.clamped(to: 0..<height) {
      UnsafeMutableRawBufferPointer(
        start: base + y * bytesPerRow + columns.lowerBound * layout.size,
        count: columns.count * layout.size
      ).initializeMemory(as: UInt8.self, repeating: 0)
    }
  }

  /// Draws one pixel for each of a rectangle, which is cut off at the rim, over what is there; nil
  /// leaves what is there.
  func draw(_ columns: Range<Int>, _ rows: Range<Int>, pixel: (Int, Int) -> PixelValue?) {
    let columns = columns.clamped(to: 0..<width)
    let (size, alpha, unused) = (layout.size, layout.alpha, layout.unused)
    let isGray = layout.colours.count == 1
    let isColour = layout.colours.count == 3
    let (red, green, blue) =
      isColour ? (layout.colours[0], layout.colours[1], layout.colours[2]) : (0, 0, 0)
    for y in rows.clamped(to: 0..<height) {
      let row = UnsafeMutableBufferPointer(
        start: (base + y * bytesPerRow).assumingMemoryBound(to: UInt8.self), count: width * size)
      for x in columns {
        guard var value = pixel(x, y), value.alpha > 0 else { continue }
        let at = x * size
        if value.alpha < 255 { value = value.over(old(row, at)) }
        let stored = layout.isPremultiplied ? value.premultiplied : value
        if isColour {
          row[at + red] = stored.red
          row[at + green] = stored.green
          row[at + blue] = stored.blue
        } else if isGray {
          row[at] = stored.gray
        }
        if let alpha { row[at + alpha] = stored.alpha }
        if let unused { row[at + unused] = 255 }
      }
    }
  }

  private func old(_ row: UnsafeMutableBufferPointer<UInt8>, _ at: Int) -> PixelValue {
    let alpha = layout.alpha.map { row[at + $0] } ?? 255
    guard let first = layout.colours.first else { return PixelValue(0, 0, 0, alpha) }
    let value =
      layout.colours.count == 3
      ? PixelValue(
        row[at + first], row[at + layout.colours[1]], row[at + layout.colours[2]], alpha)
      : PixelValue(row[at], row[at], row[at], alpha)
    return layout.isPremultiplied ? value.unpremultiplied : value
  }
}

extension PixelValue {
  /// The colour, multiplied by its opacity.
  var premultiplied: PixelValue {
    guard alpha < 255 else { return self }
    func scaled(_ value: UInt8) -> UInt8 { UInt8((Int(value) * Int(alpha) + 127) / 255) }
    return PixelValue(scaled(red), scaled(green), scaled(blue), alpha)
  }

  /// The colour, divided by its opacity.
  var unpremultiplied: PixelValue {
    guard alpha > 0, alpha < 255 else { return self }
    func scaled(_ value: UInt8) -> UInt8 {
      UInt8(min(255, (Int(value) * 255 + Int(alpha) / 2) / Int(alpha)))
    }
    return PixelValue(scaled(red), scaled(green), scaled(blue), alpha)
  }

  /// This colour on another.
  func over(_ other: PixelValue) -> PixelValue {
    // All in units of 1/65025, the product of two bytes.
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
