extension PhotogrammetrySession {
  /// Limits of the input on this machine.
  public struct Limits: Sendable {
    /// The maximum side of a photo in pixels.
    public let maximumInputImageDimension: Int
    /// The maximum number of photos.
    public let maximumNumberOfInputImages: Int
  }

  /// The limits of this machine, determined by its memory.
  public static let limits = Limits(memoryBytes: Machine.current.totalMemoryBytes)
}

extension PhotogrammetrySession.Limits {
  /// The limits for an amount of memory: 1000 photos of 16384 pixels at 8 GiB and above.
  init(memoryBytes: Int) {
    let gibibytes = Double(memoryBytes) / Double(1 << 30)
    maximumInputImageDimension = gibibytes >= 7.5 ? 16384 : 8192
    maximumNumberOfInputImages = Swift.min(1000, Swift.max(100, Int(gibibytes * 134)))
  }
}
