extension PhotogrammetrySession {
  /// Creates a session for the photos in a folder.
  ///
  /// Throws `Error.invalidImages` when the folder can't be read or is empty.
  public convenience init(input: URL, configuration: Configuration = Configuration()) throws {
    guard InputFolder(input).isUsable else { throw Error.invalidImages(input) }
    self.init(.folder(input), configuration: configuration)
  }

  /// Creates a session for a sequence of samples, which is iterated once, as the samples are read.
  ///
  /// Iteration happens on a thread of the session after `process` is called. The closures of a lazy
  /// sequence must not be isolated to the main actor, as closures in a program's `main` are in
  /// Swift 6.
  public convenience init<S>(
    input: S, configuration: Configuration = Configuration()
  ) throws where S: Sequence, S.Element == PhotogrammetrySample {
    self.init(.samples(SampleFolder(input)), configuration: configuration)
  }

  convenience init(
    _ input: SessionInput, configuration: Configuration,
    makeEngine: @escaping SessionCore.EngineFactory = ReconstructionEngine.make
  ) {
    self.init(
      SessionCore(input, configuration: configuration, makeEngine: makeEngine),
      configuration: configuration)
  }
}
