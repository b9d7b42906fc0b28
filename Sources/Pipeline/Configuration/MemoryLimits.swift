// MARK: - Limits

/// The limits of a run that follow from a machine's memory. They depend on the total memory, not on
/// the free memory, so that runs do not differ.
package struct MemoryLimits: Hashable, Sendable {
  /// The largest number of photos, whatever the memory. Limit: points of a cloud have the numbers
  /// of photos in 16 bits.
  package static let mostPhotos = 65_535

  /// Photos beyond this number are rejected.
  package var maximumPhotos: Int
  /// Photos with a longer side, in pixels, are rejected.
  package var maximumPhotoSide: Int
  /// Bytes that decoded photos may occupy.
  package var imageMemory: Int
  /// Bytes that the surface solver may use.
  package var surfaceMemory: Int
  /// Points of the dense cloud that are kept for the model, at most.
  package var cloudPoints: Int
}
