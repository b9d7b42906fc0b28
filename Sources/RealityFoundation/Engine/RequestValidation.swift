/// The checks of `process` before any work begins.
struct RequestValidation {
  let input: SessionInput
  let configuration: PhotogrammetrySession.Configuration
  let options: EngineOptions
  /// The free bytes of the disk that holds a URL; nil if unknown.
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
    try requests.forEach { try checkGeometry($0.geometry ?? .init()) }
    var paths: Set<String> = []
    for case .modelFile(let url, let detail, _) in Set(requests) {
      guard OutputLocation(url, additionalFormats: options.additionalFileFormats) != nil else {
        throw PhotogrammetrySession.Error.invalidOutput(url)
      }
      guard paths.insert(url.standardizedFileURL.path).inserted else {
        throw ProcessingError.invalidRequest(
          "Two requests write to \(url.path).", remedy: "Specify a different file for each.")
      }
      let required = detail.expectedBytes
      if let free = freeBytes(url), free < required {
        throw PhotogrammetrySession.Error.insufficientStorage(requiredBytes: required)
      }
    }
  }

  private func checkGeometry(_ geometry: PhotogrammetrySession.Request.Geometry) throws {
    let matrix = geometry.transform.matrix
    guard abs(matrix.determinant) > 1e-20, matrix.determinant.isFinite else {
      throw ProcessingError.invalidRequest(
        "The transform of a request is not invertible.",
        remedy: "Use finite numbers and nonzero scales.")
    }
    let orientation = geometry.orientedBounds.orientation
    guard orientation.length > 1e-6, orientation.length.isFinite else {
      throw ProcessingError.invalidRequest(
        "The orientation of a request's bounds is not a rotation.",
        remedy: "Pass a unit quaternion.")
    }
    let bounds = geometry.bounds
    guard all(bounds.min .<= bounds.max) || all(bounds.min .> bounds.max) else {
      throw ProcessingError.invalidRequest(
        "The bounds of a request are inverted.",
        remedy: "Pass the smallest coordinates as min and the largest as max.")
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

extension PhotogrammetrySession.Request {
  /// The geometry of the requested model; nil if none is specified or no model is requested.
  fileprivate var geometry: Geometry? {
    switch self {
    case .modelFile(_, _, let geometry), .modelEntity(_, let geometry): geometry
    case .bounds, .pointCloud, .poses: nil
    }
  }
}

extension PhotogrammetrySession.Request.Detail {
  /// The usual upper bound of the size of an output at this level.
  fileprivate var expectedBytes: Int64 {
    switch self {
    case .preview: 5_000_000
    case .reduced: 10_000_000
    case .medium, .custom: 30_000_000
    case .full, .raw: 100_000_000
    }
  }
}
