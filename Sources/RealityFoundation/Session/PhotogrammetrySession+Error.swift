extension PhotogrammetrySession {
  /// An input or output that can't be used.
  public enum Error: Swift.Error, LocalizedError, Sendable {
    /// The folder holds no photos that can be used, or is not a folder.
    case invalidImages(URL)
    /// Nothing can be written to the location, or its suffix names no format of ours.
    case invalidOutput(URL)
    /// The disk of the output has too little free space.
    case insufficientStorage(requiredBytes: Int64)
  }
}

extension PhotogrammetrySession.Error {
  /// What is wrong, and what to do about it.
  public var localizedDescription: String {
    [failureReason, recoverySuggestion].compactMap { $0 }.joined(separator: " ")
  }

  /// What is wrong, and what to do about it.
  public var errorDescription: String? { localizedDescription }

  /// What is wrong, in a sentence.
  public var failureReason: String? {
    switch self {
    case .invalidImages(let url):
      InputFolder(url).fault ?? "\(url.path) holds no photos that can be used."
    case .invalidOutput(let url):
      OutputLocation.fault(of: url) ?? "Nothing can be written to \(url.path)."
    case .insufficientStorage(let bytes):
      "The output may need \((bytes + 999_999) / 1_000_000) MB, and its disk has less free space."
    }
  }

  /// What to do about it, in a sentence.
  public var recoverySuggestion: String? {
    switch self {
    case .invalidImages:
      "Name a folder with photos (JPEG, HEIC or PNG) of one object, taken all around it."
    case .invalidOutput:
      "Name a file ending in .usdz in a folder that can be written to, "
        + "or a folder, with a slash at the end, for OBJ, MTL, USDA and textures."
    case .insufficientStorage:
      "Free some space or write to another disk."
    }
  }
}
