import SharedCommands

/// The state of a dataset: a row of the summary.
struct BatchEntry: Codable, Equatable, Sendable {
  /// The dataset's name.
  var name: String
  var status: DatasetStatus
  var photos: Int
  /// Number of photos with a pose.
  var registered: Int?
  var triangles: Int?
  /// What the run's report says about the model.
  var quality: RunQuality?
  /// Duration of all attempts.
  var seconds = 0.0
  var attempts = 0
  /// Why there is no model, with the remedy.
  var error: String?
  /// The model's file or folder, relative to the folder of models.
  var model: String
  /// Identifies the input of the model, see `BatchDataset.fingerprint(options:)`.
  var fingerprint: String
}

extension BatchEntry {
  /// Records the result of an attempt.
  mutating func record(_ result: ChildResult, seconds: Double) {
    status = result.status
    attempts += 1
    self.seconds += seconds
    error = result.error
    if let counts = result.counts {
      photos = counts.photos ?? photos
      (registered, triangles) = (counts.registered, counts.triangles)
      quality = counts.quality
    }
  }
}
