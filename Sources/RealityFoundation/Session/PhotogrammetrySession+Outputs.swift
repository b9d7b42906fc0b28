extension PhotogrammetrySession {
  /// What a session tells, from its beginning to its end.
  ///
  /// Nothing is lost before the first iteration. Iterations at the same time see the same outputs;
  /// one that begins later goes on where the farthest has been. The sequence does not end with
  /// `processingComplete` but when the session goes away.
  public struct Outputs: AsyncSequence, Sendable {
    /// What the sequence consists of.
    public typealias Element = Output
    /// The type of the errors that iteration may throw.
    public typealias Failure = any Swift.Error

    let buffer: OutputBuffer

    /// Begins an iteration.
    public func makeAsyncIterator() -> Iterator { Iterator(cursor: OutputBuffer.Cursor(buffer)) }

    /// An iteration over a session's outputs.
    public struct Iterator: AsyncIteratorProtocol {
      let cursor: OutputBuffer.Cursor

      /// Waits for the next output; nil when the session is gone or the task was cancelled.
      public mutating func next() async throws -> Output? { await cursor.next() }
    }
  }
}
