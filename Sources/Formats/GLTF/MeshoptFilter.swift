import Foundation

/// The filters of `EXT_meshopt_compression` that follow decompression.
enum MeshoptFilter {
  /// Decodes vertices of `stride` bytes in place; nil and `NONE` leave them as they are. Throws a
  /// `FormatFault`, or an `UnsupportedFeature`.
  static func apply(_ filter: String?, to bytes: inout [UInt8], stride: Int) throws {
    switch filter {
    case nil, "NONE": break
    case "OCTAHEDRAL":
      switch stride {
      case 4: octahedral(&bytes, Int8.self)
      case 8: octahedral(&bytes, Int16.self)
      default: throw FormatFault("compressed normals have \(stride) bytes")
      }
    case "EXPONENTIAL": exponential(&bytes)
    default:
      throw UnsupportedFeature(
        reason: "it has compressed views with the filter \(filter ?? "")",
        remedy: "Export it without compression.")
    }
  }

  /// Unit vectors from two coordinates in an unfolded octahedron and the value of 1; see
  /// `OctahedralNormal`. The fourth number stays.
  private static func octahedral<Number: FixedWidthInteger & SignedInteger>(
    _ bytes: inout [UInt8], _ type: Number.Type
  ) {
    let size = MemoryLayout<Number>.size
    let maximum = Float(Number.max)
    bytes.withUnsafeMutableBytes { buffer in
      for start in stride(from: 0, to: buffer.count - 4 * size + 1, by: 4 * size) {
        func number(_ index: Int) -> Float {
          Float(buffer.loadUnaligned(fromByteOffset: start + index * size, as: Number.self))
        }
        var (x, y) = (number(0), number(1))
        let z = number(2) - abs(x) - abs(y)
        let fold = max(-z, 0)
        x += x >= 0 ? -fold : fold
        y += y >= 0 ? -fold : fold
        let length = (x * x + y * y + z * z).squareRoot()
        let scale = length > 0 ? maximum / length : 0
        for (index, value) in [x, y, z].enumerated() {
          let rounded = Number((value * scale).rounded(.toNearestOrAwayFromZero))
          buffer.storeBytes(of: rounded, toByteOffset: start + index * size, as: Number.self)
        }
      }
    }
  }

  /// Floats from a mantissa of 24 bits and an exponent of 8 bits, both signed.
  private static func exponential(_ bytes: inout [UInt8]) {
    bytes.withUnsafeMutableBytes { buffer in
      for start in stride(from: 0, to: buffer.count - 3, by: 4) {
        let bits = buffer.loadUnaligned(fromByteOffset: start, as: Int32.self)
        let mantissa = Float((bits << 8) >> 8)
        let value = Float(sign: .plus, exponent: Int(bits >> 24), significand: mantissa)
        buffer.storeBytes(of: value, toByteOffset: start, as: Float.self)
      }
    }
  }
}
