import Foundation
import SceneModel

extension FeatureSet: UnitValue {
  /// The count, then one array after the other, in native byte order.
  func unitData() throws -> Data {
    var data = Data(capacity: 8 + count * Self.bytesPerFeature)
    func append(_ values: [some BitwiseCopyable]) {
      values.withUnsafeBytes { data.append(contentsOf: $0) }
    }
    append([UInt64(count)])
    for axis in 0..<2 { append(positions.map { $0[axis] }) }
    append(scales)
    append(orientations)
    append(descriptors)
    for channel in 0..<3 { append(colors.map { $0[channel] }) }
    return data
  }

  /// Limit: the sizes of the arrays.
  private static let bytesPerFeature = 4 * 4 + descriptorLength + 3

  init?(unit: Data) {
    let bytes = [UInt8](unit)
    guard bytes.count >= 8 else { return nil }
    let stored = bytes.withUnsafeBytes { $0.loadUnaligned(as: UInt64.self) }
    guard stored <= UInt64(bytes.count), bytes.count == 8 + Int(stored) * Self.bytesPerFeature
    else { return nil }
    let count = Int(stored)
    self = bytes.withUnsafeBytes { bytes in
      var reader = ArrayReader(bytes: bytes, offset: 8)
      let axes = (0..<2).map { _ in reader.array(count, of: Float.self) }
      let (scales, orientations) = (
        reader.array(count, of: Float.self), reader.array(count, of: Float.self)
      )
      let descriptors = reader.array(count * Self.descriptorLength, of: UInt8.self)
      let channels = (0..<3).map { _ in reader.array(count, of: UInt8.self) }
      return FeatureSet(
        positions: (0..<count).map { [axes[0][$0], axes[1][$0]] }, scales: scales,
        orientations: orientations, descriptors: descriptors,
        colors: (0..<count).map { [channels[0][$0], channels[1][$0], channels[2][$0]] })
    }
  }
}
