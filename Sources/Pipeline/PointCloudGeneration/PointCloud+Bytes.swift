import Foundation
import SceneModel

/// A cloud is stored in other values as the bytes of `encoded()`.
extension PointCloud: Codable {
  package init(from decoder: any Decoder) throws {
    let container = try decoder.singleValueContainer()
    self.init()
    guard append(encoded: [UInt8](try container.decode(Data.self))[...]) else {
      throw DecodingError.dataCorruptedError(
        in: container, debugDescription: "The bytes are not a point cloud.")
    }
  }

  package func encode(to encoder: any Encoder) throws {
    var container = encoder.singleValueContainer()
    try container.encode(encoded())
  }
}

extension PointCloud: UnitValue {
  init?(unit: Data) {
    self.init()
    guard append(encoded: [UInt8](unit)[...]) else { return nil }
  }

  func unitData() throws -> Data { encoded() }
}

extension PointCloud {
  /// Serializes the cloud: counts of points and of photo indices, then one array after the other.
  /// The bytes start with a `header`. Large clouds take much memory, so nothing is copied twice.
  func encoded(after header: Data = Data()) -> Data {
    let size = header.count + 16 + count * 36 + photoIndices.count * 2
    let bytes = UnsafeMutableRawBufferPointer.allocate(byteCount: size, alignment: 16)
    var end = 0
    func append<Value: BitwiseCopyable>(_ values: some Sequence<Value>) {
      for value in values {
        bytes.storeBytes(of: value, toByteOffset: end, as: Value.self)
        end += MemoryLayout<Value>.size
      }
    }
    append(header)
    append([UInt64(count), UInt64(photoIndices.count)])
    for vectors in [positions, normals] {
      for axis in 0..<3 { append(vectors.lazy.map { $0[axis] }) }
    }
    append(consistency)
    append(footprints)
    append(photoIndices)
    append(zip(photoOffsets.dropFirst(), photoOffsets).lazy.map { UInt8(clamping: $0 - $1) })
    for channel in 0..<3 { append(colors.lazy.map { $0[channel] }) }
    guard let base = bytes.baseAddress else { return Data() }
    return Data(
      bytesNoCopy: base, count: end, deallocator: .custom { start, _ in start.deallocate() })
  }

  /// Appends a cloud serialized by `encoded`; returns false, with nothing appended, if the bytes
  /// are malformed.
  mutating func append(encoded bytes: ArraySlice<UInt8>) -> Bool {
    bytes.withUnsafeBytes { bytes in
      guard bytes.count >= 16 else { return false }
      let counts = (0..<2).map { bytes.loadUnaligned(fromByteOffset: 8 * $0, as: UInt64.self) }
      guard counts.allSatisfy({ $0 <= UInt64(bytes.count) }) else { return false }
      let (points, indices) = (Int(counts[0]), Int(counts[1]))
      guard bytes.count == 16 + points * 36 + indices * 2 else { return false }
      var reader = ArrayReader(bytes: bytes, offset: 16)
      let vectors = (0..<6).map { _ in reader.array(points, of: Float.self) }
      let values = (0..<2).map { _ in reader.array(points, of: Float.self) }
      let photos = reader.array(indices, of: UInt16.self)
      let photoCounts = reader.array(points, of: UInt8.self)
      guard photoCounts.reduce(0, { $0 + Int($1) }) == indices else { return false }
      let channels = (0..<3).map { _ in reader.array(points, of: UInt8.self) }
      for i in 0..<points {
        positions.append([vectors[0][i], vectors[1][i], vectors[2][i]])
        normals.append([vectors[3][i], vectors[4][i], vectors[5][i]])
        colors.append([channels[0][i], channels[1][i], channels[2][i]])
        photoOffsets.append((photoOffsets.last ?? 0) + UInt32(photoCounts[i]))
      }
      consistency += values[0]
      footprints += values[1]
      photoIndices += photos
      return true
    }
  }
}
