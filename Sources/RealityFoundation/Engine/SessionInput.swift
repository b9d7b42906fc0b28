/// The source of a session's photos.
enum SessionInput: Sendable {
  case folder(URL)
  case samples(SampleFolder)
}

extension SessionInput {
  /// The number of files that may be photos.
  var fileCount: Int {
    switch self {
    case .folder(let url): InputFolder(url).visibleNames?.count ?? 0
    case .samples: 0
    }
  }
}
