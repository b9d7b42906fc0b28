import Foundation

// macOS distinguishes free space from space that can be purged. There is no such distinction here,
// so these keys are aliases of one key.

extension URLResourceKey {
  /// The free space of a volume for important resources, in bytes.
  public static let volumeAvailableCapacityForImportantUsageKey = volumeAvailableCapacityKey
  /// The free space of a volume for opportunistic resources, in bytes.
  public static let volumeAvailableCapacityForOpportunisticUsageKey = volumeAvailableCapacityKey
}

extension URLResourceValues {
  /// The free space of the volume in bytes.
  public var volumeAvailableCapacityForImportantUsage: Int64? {
    volumeAvailableCapacity.map { Int64($0) }
  }

  /// The free space of the volume in bytes.
  public var volumeAvailableCapacityForOpportunisticUsage: Int64? {
    volumeAvailableCapacity.map { Int64($0) }
  }
}
