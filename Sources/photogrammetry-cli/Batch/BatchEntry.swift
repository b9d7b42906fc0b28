/// What became of a dataset: a line of the summary.
struct BatchEntry: Codable, Equatable {
  enum Status: String, Codable, CaseIterable {
    case done
    /// Done by an earlier run from the same photos and options.
    case skipped
    case failed
    /// Not finished when the batch was interrupted.
    case cancelled
  }

  var name: String
  var status: Status
  var photos: Int
  /// Photos that have a place.
  var registered: Int?
  var triangles: Int?
  /// Of all attempts.
  var seconds = 0.0
  var attempts = 0
  /// Why there is no model, with the remedy.
  var error: String?
  /// The file or folder with the model, in the folder of models.
  var model: String
  /// What the model was made of, see `BatchDataset.stamp(options:)`.
  var stamp: String
}
