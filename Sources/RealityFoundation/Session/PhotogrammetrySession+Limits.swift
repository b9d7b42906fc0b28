extension PhotogrammetrySession {
  /// What this machine can take in.
  public struct Limits: Sendable {
    /// The longest side of a photo in pixels.
    public let maximumInputImageDimension: Int
    /// The number of photos that are used at most.
    public let maximumNumberOfInputImages: Int
  }

  /// The limits of this machine, by its memory.
  public static let limits = Limits(memoryBytes: Machine.current.totalMemoryBytes)
}

extension PhotogrammetrySession.Limits {
  /// The limits of a machine with so much memory: 1000 photos of 16384 pixels from 8 GiB on.
  init(memoryBytes: Int) {
    let gibibytes = Double(memoryBytes) / Double(1 << 30)
    maximumInputImageDimension = gibibytes >= 7.5 ? 16384 : 8192
    maximumNumberOfInputImages = Swift.min(1000, Swift.max(100, Int(gibibytes * 134)))
  }
}
