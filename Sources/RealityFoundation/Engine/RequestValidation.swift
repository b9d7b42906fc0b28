/// What `process` checks before any work begins.
struct RequestValidation {
  let input: SessionInput
  let configuration: PhotogrammetrySession.Configuration
  let options: EngineOptions
  /// Free bytes of the disk that holds a URL; nil where that can't be told.
  var freeBytes: (URL) -> Int64? = Self.freeBytes

  func check(_ requests: [PhotogrammetrySession.Request]) throws {
    guard !requests.isEmpty else {
      throw ProcessingError.invalidRequest(
        "No request was given.", remedy: "Pass at least one, for instance a modelFile.")
    }
    if case .folder(let url) = input, !InputFolder(url).isUsable {
      throw PhotogrammetrySession.Error.invalidImages(url)
    }
    try checkCheckpoint()
    var paths: Set<String> = []
    for case .modelFile(let url, let detail, _) in Set(requests) {
      _ = try OutputLocation(url, additionalFormats: options.additionalFileFormats)
      guard paths.insert(url.standardizedFileURL.path).inserted else {
        throw ProcessingError.invalidRequest(
          "Two requests write to \(url.path).", remedy: "Give each its own file.")
      }
      let required = detail.expectedBytes
      if let free = freeBytes(url), free < required {
        throw PhotogrammetrySession.Error.insufficientStorage(requiredBytes: required)
      }
    }
  }

  private func checkCheckpoint() throws {
    guard let url = configuration.checkpointDirectory else { return }
    let folder = URL(fileURLWithPath: url.path, isDirectory: true)
    guard let fault = OutputLocation.fault(of: folder) else { return }
    throw ProcessingError(
      code: .checkpointUnusable, reason: "The checkpoint folder can't be used: \(fault)",
      remedy: "Name a folder that can be written to, or none.")
  }

  private static func freeBytes(_ url: URL) -> Int64? {
    var folder = url.standardizedFileURL
    while !FileManager.default.fileExists(atPath: folder.path), folder.path != "/" {
      folder = folder.deletingLastPathComponent()
    }
    let attributes = try? FileManager.default.attributesOfFileSystem(forPath: folder.path)
    return (attributes?[.systemFreeSize] as? NSNumber)?.int64Value
  }
}

extension PhotogrammetrySession.Request.Detail {
  /// The size that an output of the level usually stays below.
  fileprivate var expectedBytes: Int64 {
    switch self {
    case .preview: 5_000_000
    case .reduced: 10_000_000
    case .medium, .custom: 30_000_000
    case .full, .raw: 100_000_000
    }
  }
}
