extension PhotogrammetrySample {
  /// Loads a photo from a file.
  public init(contentsOf url: URL) throws {
    throw ProcessingError.notAvailable(
      "\(url.path) can't be loaded as a sample on this system.",
      remedy: "Put the photos into a folder and pass the folder to the session.")
  }

  /// Loads a photo from a file.
  public init(contentsOf url: URL) async throws {
    throw ProcessingError.notAvailable(
      "\(url.path) can't be loaded as a sample on this system.",
      remedy: "Put the photos into a folder and pass the folder to the session.")
  }
}
