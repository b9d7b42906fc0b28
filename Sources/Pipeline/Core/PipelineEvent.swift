import SceneModel

/// What a run tells while it works.
package enum PipelineEvent: Sendable {
  case progress(PipelineStage, fraction: Double)
  /// Validation is over; these photos are used.
  case ingested(PhotoTotals)
  /// A photo is not used, and why: refused by validation or not registered by alignment.
  case refused(RefusedPhoto)
  /// Photos are processed at a lower resolution than they have, to fit the memory.
  case downsampled
  case stitchingIncomplete(registered: Int, of: Int)
  case warning(String)
  /// Something for the user who wants to know more.
  case detail(String)
}
