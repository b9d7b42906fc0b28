import Foundation

// The Mac tells the space that it could make free apart from the space that is free. Here both are the
// same, so these are other names of one key.

extension URLResourceKey {
  /// The free space of a disk, for what the user wants.
  public static let volumeAvailableCapacityForImportantUsageKey = volumeAvailableCapacityKey
  /// The free space of a disk, for what could be fetched again.
  public static let volumeAvailableCapacityForOpportunisticUsageKey = volumeAvailableCapacityKey
}

extension URLResourceValues {
  /// The free space of the disk in bytes.
  public var volumeAvailableCapacityForImportantUsage: Int64? {
    volumeAvailableCapacity.map { Int64($0) }
  }

  /// The free space of the disk in bytes.
  public var volumeAvailableCapacityForOpportunisticUsage: Int64? {
    volumeAvailableCapacity.map { Int64($0) }
  }
}
