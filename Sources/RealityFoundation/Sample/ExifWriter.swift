import Formats

/// Writes the EXIF data of a photo (CIPA DC-008): a TIFF structure without pixels.
struct ExifWriter {
  /// The value of a field.
  enum Value: Hashable {
    case text(String)
    case short(UInt16)
    /// Non-negative numbers with six decimals, at most 4000.
    case rationals([Double])
  }

  /// Fields by tag: of the image, Exif and GPS directories.
  var image: [UInt16: Value] = [:]
  var camera: [UInt16: Value] = [:]
  var gps: [UInt16: Value] = [:]

  /// The structure in big-endian byte order.
  var bytes: [UInt8] {
    // The image directory points to the other two, so their offsets are computed first.
    let pointers = (camera.isEmpty ? 0 : 1) + (gps.isEmpty ? 0 : 1)
    let cameraOffset = 8 + size(image, extra: pointers)
    let gpsOffset = cameraOffset + (camera.isEmpty ? 0 : size(camera))
    var links: [(UInt16, Int)] = []
    if !camera.isEmpty { links.append((34665, cameraOffset)) }
    if !gps.isEmpty { links.append((34853, gpsOffset)) }
    var result: [UInt8] = Array("MM".utf8) + big16(42) + big32(8)
    result += directory(image, links, at: 8)
    if !camera.isEmpty { result += directory(camera, [], at: cameraOffset) }
    if !gps.isEmpty { result += directory(gps, [], at: gpsOffset) }
    return result
  }

  private func size(_ fields: [UInt16: Value], extra: Int = 0) -> Int {
    6 + 12 * (fields.count + extra)
      + fields.values.map { $0.payload.count > 4 ? $0.payload.count : 0 }.reduce(0, +)
  }

  private func directory(
    _ fields: [UInt16: Value], _ links: [(UInt16, Int)], at offset: Int
  ) -> [UInt8] {
    var entries = fields.map { (tag: $0, type: $1.type, count: $1.count, payload: $1.payload) }
    entries += links.map { (tag: $0, type: 4, count: 1, payload: big32($1)) }
    entries.sort { $0.tag < $1.tag }
    var entryBytes = big16(entries.count)
    var data: [UInt8] = []
    let dataOffset = offset + 6 + 12 * entries.count
    for entry in entries {
      entryBytes += big16(Int(entry.tag)) + big16(entry.type) + big32(entry.count)
      if entry.payload.count > 4 {
        entryBytes += big32(dataOffset + data.count)
        data += entry.payload
      } else {
        entryBytes += entry.payload + Array(repeating: 0, count: 4 - entry.payload.count)
      }
    }
    return entryBytes + big32(0) + data
  }

  /// Inserts the data into a PNG file as an `eXIf` chunk before the pixels.
  func inserted(intoPNG png: [UInt8]) -> [UInt8] {
    // The signature has 8 bytes; the header chunk, always first, has 25.
    guard png.count > 33 else { return png }
    let content = Array("eXIf".utf8) + bytes
    let chunk = big32(content.count - 4) + content + big32(Int(CRC32.checksum(content)))
    return png[..<33] + chunk + png[33...]
  }
}

extension ExifWriter.Value {
  fileprivate var type: Int {
    switch self {
    case .text: 2
    case .short: 3
    case .rationals: 5
    }
  }

  fileprivate var count: Int {
    switch self {
    case .text: payload.count
    case .short: 1
    case .rationals(let values): values.count
    }
  }

  /// The bytes of the value; text is padded to an even number of bytes.
  fileprivate var payload: [UInt8] {
    switch self {
    case .text(let text):
      let bytes = Array(text.utf8.prefix(1000)) + [0]
      return bytes.count % 2 == 0 ? bytes : bytes + [0]
    case .short(let value): return big16(Int(value))
    case .rationals(let values):
      return values.flatMap { value in
        let millionths = value.isFinite ? min(max(value, 0), 4000) * 1_000_000 : 0
        return big32(Int(millionths.rounded())) + big32(1_000_000)
      }
    }
  }
}

private func big16(_ value: Int) -> [UInt8] { [UInt8(value >> 8 & 255), UInt8(value & 255)] }

private func big32(_ value: Int) -> [UInt8] { big16(value >> 16) + big16(value & 0xFFFF) }
