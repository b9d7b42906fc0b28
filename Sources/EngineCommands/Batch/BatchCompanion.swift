/// A file that a batch writes next to each model.
enum BatchCompanion: CaseIterable, Sendable {
  case preview, report, poses, pointCloud

  /// The option of `reconstruct` that names the file.
  var option: String {
    switch self {
    case .preview: "--preview"
    case .report: "--report"
    case .poses: "--poses"
    case .pointCloud: "--point-cloud"
    }
  }

  /// The end of the file's name, after that of the dataset.
  var suffix: String {
    switch self {
    case .preview: ".png"
    case .report: ".html"
    case .poses: ".poses.json"
    case .pointCloud: ".points.ply"
    }
  }
}
