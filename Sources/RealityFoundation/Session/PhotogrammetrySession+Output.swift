extension PhotogrammetrySession {
  /// What a session tells while it works.
  public enum Output: Sendable {
    /// All photos were read.
    case inputComplete
    /// A request can't be met; the others go on.
    case requestError(Request, any Swift.Error)
    /// A request was met.
    case requestComplete(Request, Result)
    /// How far a request is, from 0 to 1.
    case requestProgress(Request, fractionComplete: Double)
    /// All requests have ended.
    case processingComplete
    /// Processing has stopped after `cancel()`.
    case processingCancelled
    /// A photo can't be used, and why.
    case invalidSample(id: Int, reason: String)
    /// A photo was valid but could not be placed.
    case skippedSample(id: Int)
    /// Photos are used at a lower resolution to fit the memory.
    case automaticDownsampling
    /// More about the progress of a request.
    case requestProgressInfo(Request, ProgressInfo)
    /// Only some of the photos could be put together.
    case stitchingIncomplete

    /// More about the progress of a request.
    public struct ProgressInfo: Sendable {
      /// The time until the request is met in seconds, nil where that can't be told yet.
      public let estimatedRemainingTime: TimeInterval?
      /// What is being done.
      public let processingStage: ProcessingStage?
    }

    /// The stages of processing, in their order.
    public enum ProcessingStage: Hashable, Sendable {
      /// Photos are read and checked.
      case preProcessing
      /// Cameras are placed.
      case imageAlignment
      /// Points on the surface are found.
      case pointCloudGeneration
      /// A surface is put through the points.
      case meshGeneration
      /// Textures are made.
      case textureMapping
      /// The result is written.
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
    case .processingCancelled: "Processing was cancelled."
    case .invalidSample(let id, let reason): "Sample \(id) can't be used: \(reason)"
    case .skippedSample(let id): "Sample \(id) was skipped."
    case .automaticDownsampling: "Photos are used at a lower resolution to fit the memory."
    case .requestProgressInfo(_, let info):
      info.estimatedRemainingTime.map { "About \(Int($0.rounded(.up))) s remain." }
        ?? "The remaining time is not known yet."
    case .stitchingIncomplete: "Only some of the photos could be put together."
    }
  }
}
