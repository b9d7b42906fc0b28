/// Writes OpenEXR files without compression.
package struct EXRWriter: Sendable {
  /// How samples are stored.
  package enum Sample: Int, Sendable {
    case half = 1
    case float = 2
  }

  /// Channels by name, each with a value per pixel of the data window, row by row.
  package var channels: [String: [Float]]
  /// Size in pixels of the data window.
  package var width: Int
  package var height: Int
  package var sample = Sample.half
  /// Side of square tiles; nil for lines.
  package var tileSide: Int?
  /// The place of the data window, and of the display window if it is another.
  package var origin = SIMD2(0, 0)
  package var display: (origin: SIMD2<Int>, size: SIMD2<Int>)?
  /// x and y of red, green, blue and white.
  package var chromaticities: [Float] = []

  package init(width: Int, height: Int, _ channels: [String: [Float]]) {
    (self.width, self.height, self.channels) = (width, height, channels)
  }

  /// The names in the order of the file.
  private var names: [String] { channels.keys.sorted() }

  package var file: [UInt8] {
    let blocks = tileSide.map(tiles) ?? lines
    let start = header.count + 8 * blocks.count
    var offsets: [UInt8] = []
    var content: [UInt8] = []
    for block in blocks {
      offsets += littleEndian(start + content.count, 8)
      content += block
    }
    return header + offsets + content
  }

  private var header: [UInt8] {
    let end = origin &+ SIMD2(width - 1, height - 1)
    let data = [origin.x, origin.y, end.x, end.y]
    let shown = display.map {
      [
        $0.origin.x, $0.origin.y, $0.origin.x + $0.size.x - 1,
        $0.origin.y + $0.size.y - 1,
      ]
    }
    var list: [UInt8] = []
    for name in names {
      list += Array(name.utf8) + [0] + littleEndian(sample.rawValue)
      list += littleEndian(0) + littleEndian(1) + littleEndian(1)
    }
    var attributes = attribute("channels", "chlist", list + [0])
    attributes += attribute("compression", "compression", [0])
    attributes += attribute("dataWindow", "box2i", data.flatMap { littleEndian($0) })
    attributes += attribute("displayWindow", "box2i", (shown ?? data).flatMap { littleEndian($0) })
    attributes += attribute("lineOrder", "lineOrder", [0])
    attributes += attribute("pixelAspectRatio", "float", bytes(1))
    attributes += attribute("screenWindowCenter", "v2f", bytes(0) + bytes(0))
    attributes += attribute("screenWindowWidth", "float", bytes(1))
    if !chromaticities.isEmpty {
      attributes += attribute(
        "chromaticities", "chromaticities", chromaticities.flatMap { bytes($0) })
    }
    if let tileSide {
      let description = littleEndian(tileSide) + littleEndian(tileSide) + [0]
      attributes += attribute("tiles", "tiledesc", description)
    }
    let start: [UInt8] = [0x76, 0x2F, 0x31, 0x01, 2, tileSide == nil ? 0 : 2, 0, 0]
    return start + attributes + [0]
  }

  private func attribute(_ name: String, _ type: String, _ value: [UInt8]) -> [UInt8] {
    Array(name.utf8) + [0] + Array(type.utf8) + [0] + littleEndian(value.count) + value
  }

  private func bytes(_ value: Float) -> [UInt8] { littleEndian(Int(value.bitPattern)) }

  private var lines: [[UInt8]] {
    (0..<height).map { row in
      let content = pixels(0..<width, row..<row + 1)
      return littleEndian(origin.y + row) + littleEndian(content.count) + content
    }
  }

  private func tiles(side: Int) -> [[UInt8]] {
    stride(from: 0, to: height, by: side).flatMap { top in
      stride(from: 0, to: width, by: side).map { left in
        let content = pixels(left..<min(left + side, width), top..<min(top + side, height))
        let place = littleEndian(left / side) + littleEndian(top / side)
        return place + littleEndian(0, 8) + littleEndian(content.count) + content
      }
    }
  }

  /// Row by row; in each, one channel after another.
  private func pixels(_ columns: Range<Int>, _ rows: Range<Int>) -> [UInt8] {
    var result: [UInt8] = []
    for row in rows {
      for name in names {
        for column in columns {
          let value = channels[name]?[row * width + column] ?? 0
          result +=
            sample == .float ? bytes(value) : littleEndian(Int(Float16(value).bitPattern), 2)
        }
      }
    }
    return result
  }
}
