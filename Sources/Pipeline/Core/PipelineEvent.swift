import SceneModel

/// What a run reports while it works.
package enum PipelineEvent: Sendable {
  case progress(PipelineStage, fraction: Double)
  /// Validation has ended; these photos are used.
  case ingested(PhotoTotals)
  /// A photo is not used, with the reason: refused by validation or not registered by alignment.
  case refused(RefusedPhoto)
  /// Photos are downsampled to fit into memory.
  case downsampled
  case stitchingIncomplete(registered: Int, of: Int)
  case warning(String)
  /// Additional information for verbose logs, as a sentence.
  case detail(String)
}
