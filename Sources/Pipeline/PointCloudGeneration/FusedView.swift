import SceneModel

/// The points of a cloud that come from the patches of one view.
struct FusedView: Sendable {
  /// Without the points outside the masks.
  var cloud = PointCloud()
  /// The number of patches that the points come from.
  var acceptedPatches: Int
  var pointsOutsideMasks: Int
}

/// Its bytes are the two numbers, then those of the cloud.
extension FusedView {
  private static let headerSize = 2 * MemoryLayout<UInt64>.size

  /// Nil if the bytes are not those of `encoded`.
  init?(encoded bytes: ArraySlice<UInt8>) {
    guard bytes.count >= Self.headerSize else { return nil }
    let counts = bytes.withUnsafeBytes { bytes in
      (0..<2).map {
        Int(clamping: bytes.loadUnaligned(fromByteOffset: 8 * $0, as: UInt64.self))
      }
    }
    self.init(acceptedPatches: counts[0], pointsOutsideMasks: counts[1])
    guard cloud.append(encoded: bytes.dropFirst(Self.headerSize)) else { return nil }
  }

  var encoded: [UInt8] {
    let counts = [UInt64(acceptedPatches), UInt64(pointsOutsideMasks)]
    return counts.withUnsafeBytes { Array($0) } + cloud.encoded()
  }
}
