import SceneModel

/// What a run reports while it works.
package enum PipelineEvent: Sendable {
  /// The completed fraction of a stage, 0…1.
  case progress(PipelineStage, fraction: Double)
  /// A stage has more work than was expected, this many times as much in all. Its completed
  /// fraction decreases accordingly.
  case extended(PipelineStage, by: Double)
  /// Validation has ended; these photos are used.
  case ingested(PhotoTotals)
  /// A photo is not used, with the reason: rejected by validation or not registered by alignment.
  case rejected(RejectedPhoto)
  /// Photos are downsampled to fit into memory.
  case downsampled
  /// Alignment registered only some of the photos.
  case stitchingIncomplete(registered: Int, of: Int)
  /// A warning for the user, as a sentence.
  case warning(String)
  /// Additional information for verbose logs, as a sentence.
  case detail(String)
}
