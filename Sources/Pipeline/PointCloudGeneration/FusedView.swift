import SceneModel

/// The points of a cloud that come from the patches of one view.
struct FusedView: Sendable {
  /// Without the points outside the masks.
  var cloud = PointCloud()
  /// The number of patches that the points come from.
  var acceptedPatches: Int
  var pointsOutsideMasks: Int

  init(cloud: PointCloud, acceptedPatches: Int, pointsOutsideMasks: Int) {
    (self.cloud, self.acceptedPatches) = (cloud, acceptedPatches)
    self.pointsOutsideMasks = pointsOutsideMasks
  }

  /// Nil if the bytes are not those of `encoded`.
  init?(encoded bytes: ArraySlice<UInt8>) {
    guard bytes.count >= Self.headerSize else { return nil }
    (acceptedPatches, pointsOutsideMasks) = bytes.withUnsafeBytes { bytes in
      let count = { Int(clamping: bytes.loadUnaligned(fromByteOffset: 8 * $0, as: UInt64.self)) }
      return (count(0), count(1))
    }
    guard cloud.append(encoded: bytes.dropFirst(Self.headerSize)) else { return nil }
  }

  /// The two numbers, then the cloud.
  var encoded: [UInt8] {
    let counts = [UInt64(acceptedPatches), UInt64(pointsOutsideMasks)]
    return counts.withUnsafeBytes { Array($0) } + cloud.encoded()
  }

  private static let headerSize = 2 * MemoryLayout<UInt64>.size
}
