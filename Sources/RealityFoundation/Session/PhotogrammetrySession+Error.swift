extension PhotogrammetrySession {
  /// An input or output that can't be used.
  public enum Error: Swift.Error, LocalizedError, Sendable {
    /// The folder contains no usable photos, or is not a folder.
    case invalidImages(URL)
    /// The location is not writable, or its extension is not a supported format.
    case invalidOutput(URL)
    /// The volume of the output has too little free space.
    case insufficientStorage(requiredBytes: Int64)
  }
}

extension PhotogrammetrySession.Error {
  /// The reason and the remedy.
  public var localizedDescription: String {
    [failureReason, recoverySuggestion].compactMap { $0 }.joined(separator: " ")
  }

  /// The reason and the remedy.
  public var errorDescription: String? { localizedDescription }

  /// What is wrong, in one sentence.
  public var failureReason: String? {
    switch self {
    case .invalidImages(let url):
      InputFolder(url).fault ?? "\(url.path) contains no usable photos."
    case .invalidOutput(let url):
      OutputLocation.fault(of: url) ?? "Nothing can be written to \(url.path)."
    case .insufficientStorage(let bytes):
      "The output may need \((bytes + 999_999) / 1_000_000) MB, and its disk has less free space."
    }
  }

  /// What to do about it, in one sentence.
  public var recoverySuggestion: String? {
    switch self {
    case .invalidImages:
      "Specify a folder with photos (JPEG, HEIC or PNG) of one object, taken all around it."
    case .invalidOutput:
      "Specify a file ending in .usdz in a writable folder, "
        + "or a folder, with a slash at the end, for OBJ, MTL, USDA and textures."
    case .insufficientStorage:
      "Free some space or write to another disk."
    }
  }
}
