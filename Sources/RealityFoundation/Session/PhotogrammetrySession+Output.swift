extension PhotogrammetrySession {
  /// What a session reports while it works.
  public enum Output: Sendable {
    /// All photos have been read.
    case inputComplete
    /// A request failed; the others continue.
    case requestError(Request, any Swift.Error)
    /// A request was completed.
    case requestComplete(Request, Result)
    /// The progress of a request, from 0 to 1.
    case requestProgress(Request, fractionComplete: Double)
    /// All requests have ended.
    case processingComplete
    /// Processing was canceled by `cancel()`.
    case processingCancelled
    /// A photo can't be used, with the reason.
    case invalidSample(id: Int, reason: String)
    /// A valid photo could not be registered.
    case skippedSample(id: Int)
    /// Photos are downsampled to fit into memory.
    case automaticDownsampling
    /// Details about the progress of a request.
    case requestProgressInfo(Request, ProgressInfo)
    /// Only some of the photos could be registered together.
    case stitchingIncomplete

    /// Details about the progress of a request.
    public struct ProgressInfo: Sendable {
      /// The estimated time in seconds until the request is completed; nil while there is no
      /// estimate.
      public let estimatedRemainingTime: TimeInterval?
      /// The current stage.
      public let processingStage: ProcessingStage?
    }

    /// The processing stages in order.
    public enum ProcessingStage: Hashable, Sendable {
      /// Reads and checks the photos.
      case preProcessing
      /// Estimates the camera poses.
      case imageAlignment
      /// Reconstructs points on the surface.
      case pointCloudGeneration
      /// Reconstructs a surface from the points.
      case meshGeneration
      /// Makes the textures.
      case textureMapping
      /// Writes the result.
      case optimization
    }
  }
}

extension PhotogrammetrySession.Output {
  /// The output as a sentence.
  public var localizedDescription: String {
    switch self {
    case .inputComplete: "All photos were read."
    case .requestError(_, let error): "A request failed: \(sentence(of: error))"
    case .requestComplete: "A request is complete."
    case .requestProgress(_, let fraction):
      "A request is \(Int((fraction * 100).rounded(.down))) % complete."
    case .processingComplete: "Processing is complete."
    case .processingCancelled: "Processing was canceled."
    case .invalidSample(let id, let reason): "Sample \(id) can't be used: \(reason)"
    case .skippedSample(let id): "Sample \(id) was skipped."
    case .automaticDownsampling: "Photos are used at a lower resolution to fit the memory."
    case .requestProgressInfo(_, let info):
      info.estimatedRemainingTime.map { "About \(Int($0.rounded(.up))) s remaining." }
        ?? "The remaining time is not yet known."
    case .stitchingIncomplete: "Only some of the photos could be registered together."
    }
  }
}
