/// Writes ICC display profiles (ISO 15076-1): primaries and the sRGB transfer curve.
package enum ICCWriter {
  /// Primaries as XYZ under D50: red, green and blue.
  package struct Primaries: Sendable {
    package var red: SIMD3<Double>
    package var green: SIMD3<Double>
    package var blue: SIMD3<Double>

    /// As in sRGB profiles (IEC 61966-2-1, Bradford-adapted).
    package static let sRGB = Primaries(
      red: [0.43607, 0.22249, 0.01392], green: [0.38515, 0.71687, 0.09708],
      blue: [0.14307, 0.06061, 0.71410])
    /// As in Display P3 profiles.
    package static let displayP3 = Primaries(
      red: [0.51512, 0.24120, -0.00105], green: [0.29198, 0.69225, 0.04189],
      blue: [0.15710, 0.06657, 0.78407])
  }

  /// A profile with the given primaries.
  package static func profile(_ primaries: Primaries) -> [UInt8] {
    let name =
      Array("mluc".utf8) + zeros(4) + bigEndian(1) + bigEndian(12) + Array("enUS".utf8)
      + bigEndian(2) + bigEndian(28) + [0, 0x41, 0, 0]
    // Exponent, slope, offset, slope of the linear part and its end.
    let curve =
      Array("para".utf8) + zeros(4) + [0, 3, 0, 0]
      + [2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045].flatMap { fixed($0) }
    let tags: [(name: String, content: [UInt8])] = [
      ("desc", name), ("cprt", name), ("wtpt", xyz([0.9642, 1, 0.8249])),
      ("rXYZ", xyz(primaries.red)), ("gXYZ", xyz(primaries.green)),
      ("bXYZ", xyz(primaries.blue)), ("rTRC", curve), ("gTRC", curve), ("bTRC", curve),
    ]
    var table = bigEndian(tags.count)
    var content: [UInt8] = []
    for tag in tags {
      table += Array(tag.name.utf8) + bigEndian(132 + 12 * tags.count + content.count)
      table += bigEndian(tag.content.count)
      content += tag.content
    }
    let header =
      bigEndian(128 + table.count + content.count) + zeros(4) + bigEndian(0x0400_0000)
      + Array("mntrRGB XYZ ".utf8) + zeros(12) + Array("acsp".utf8) + zeros(28)
      + [0.9642, 1, 0.8249].flatMap { fixed($0) } + zeros(48)
    return header + table + content
  }

  private static func xyz(_ value: SIMD3<Double>) -> [UInt8] {
    Array("XYZ ".utf8) + zeros(4) + fixed(value.x) + fixed(value.y) + fixed(value.z)
  }

  /// s15Fixed16 number.
  private static func fixed(_ value: Double) -> [UInt8] {
    bigEndian(Int((value * 65536).rounded()))
  }

  private static func zeros(_ count: Int) -> [UInt8] { [UInt8](repeating: 0, count: count) }
}
