import Foundation

/// Reads the rows of an ascii or binary PLY file in order.
struct PLYReader {
  let header: PLYHeader
  private var source: Source

  private enum Source {
    case binary(ByteCursor)
    case text(bytes: [UInt8], offset: Int)
  }

  init(_ bytes: [UInt8]) throws {
    header = try PLYHeader(bytes)
    source =
      header.encoding == .ascii
      ? .text(bytes: bytes, offset: header.length)
      : .binary(
        ByteCursor(bytes, from: header.length, isBigEndian: header.encoding == .bigEndian))
    var needed = 0
    for element in header.elements {
      let (size, overflow) = element.count.multipliedReportingOverflow(
        by: element.minimumRowSize(header.encoding))
      guard !overflow, size <= bytes.count, needed + size <= bytes.count else {
        throw FormatFault(
          "its header declares \(element.count) \(element.name) elements, but it is too short")
      }
      needed += size
    }
  }

  /// Calls `body` with the element and each of its rows, in file order.
  mutating func forEachRow(_ body: (PLYHeader.Element, PLYRow) throws -> Void) throws {
    do {
      for element in header.elements {
        var row = PLYRow(
          scalars: [Double](repeating: 0, count: element.properties.count),
          lists: [[Double]](repeating: [], count: element.properties.count))
        for _ in 0..<element.count {
          try readRow(of: element, into: &row)
          try body(element, row)
        }
      }
    } catch is ByteCursor.Truncated {
      throw FormatFault("it ends before its last element")
    }
  }

  private mutating func readRow(of element: PLYHeader.Element, into row: inout PLYRow) throws {
    for (index, property) in element.properties.enumerated() {
      guard let countType = property.countType else {
        row.scalars[index] = try readScalar(property.type)
        continue
      }
      let count = try readScalar(countType)
      guard count >= 0, count <= Double(remaining) else {
        throw FormatFault("a list has the impossible length \(count)")
      }
      row.lists[index].removeAll(keepingCapacity: true)
      for _ in 0..<Int(count) { row.lists[index].append(try readScalar(property.type)) }
    }
  }

  private var remaining: Int {
    switch source {
    case .binary(let reader): reader.remaining
    case .text(let bytes, let offset): bytes.count - offset
    }
  }

  private mutating func readScalar(_ type: PLYHeader.ScalarType) throws -> Double {
    switch source {
    case .binary(var reader):
      let bits = try reader.unsigned(type.size)
      source = .binary(reader)
      return Self.value(bits, type)
    case .text(let bytes, var offset):
      let word = try Self.word(bytes, &offset)
      source = .text(bytes: bytes, offset: offset)
      guard let value = Double(word) else { throw FormatFault("'\(word)' is not a number") }
      return value
    }
  }

  private static func value(_ bits: UInt64, _ type: PLYHeader.ScalarType) -> Double {
    switch type {
    case .int8: Double(Int8(truncatingIfNeeded: bits))
    case .int16: Double(Int16(truncatingIfNeeded: bits))
    case .int32: Double(Int32(truncatingIfNeeded: bits))
    case .uint8, .uint16, .uint32: Double(bits)
    case .float32: Double(Float(bitPattern: UInt32(truncatingIfNeeded: bits)))
    case .float64: Double(bitPattern: bits)
    }
  }

  /// The next word of a text, delimited by white space and control characters.
  private static func word(_ bytes: [UInt8], _ offset: inout Int) throws -> String {
    while offset < bytes.count, bytes[offset] <= 32 { offset += 1 }
    let start = offset
    while offset < bytes.count, bytes[offset] > 32 { offset += 1 }
    guard offset > start else { throw ByteCursor.Truncated() }
    return String(decoding: bytes[start..<offset], as: UTF8.self)
  }
}
