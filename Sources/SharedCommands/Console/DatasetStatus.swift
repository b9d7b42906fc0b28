/// The state of a dataset in the summary and the events of a batch.
package enum DatasetStatus: String, Codable, CaseIterable, Sendable {
  /// Its model was written.
  case done
  /// Done by an earlier batch from the same photos and options.
  case skipped
  /// It has no model.
  case failed
  /// Not finished when the batch was interrupted.
  case cancelled
}
