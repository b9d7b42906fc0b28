import Pipeline

extension PhotogrammetrySession {
  /// Limits of the input on this machine.
  public struct Limits: Sendable {
    /// The maximum side of a photo in pixels.
    public let maximumInputImageDimension: Int
    /// The maximum number of photos.
    public let maximumNumberOfInputImages: Int
  }

  /// The limits of this machine, determined by its memory.
  public static let limits = Limits(Machine.current.limits)
}

extension PhotogrammetrySession.Limits {
  init(_ limits: MemoryLimits) {
    maximumInputImageDimension = limits.maximumPhotoSide
    maximumNumberOfInputImages = limits.maximumPhotos
  }
}
