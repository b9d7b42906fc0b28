extension PhotogrammetrySession {
  /// The outputs of a session over its whole lifetime.
  ///
  /// Outputs are buffered until the first iteration. Concurrent iterations receive the same
  /// outputs; a later one starts at the position of the most advanced one. The sequence does not
  /// end at `processingComplete` but when the session is deallocated.
  public struct Outputs: AsyncSequence, Sendable {
    /// The elements of the sequence.
    public typealias Element = Output
    /// The type of the errors that iteration may throw.
    public typealias Failure = any Swift.Error

    let buffer: OutputBuffer

    /// Starts an iteration.
    public func makeAsyncIterator() -> Iterator { Iterator(cursor: OutputBuffer.Cursor(buffer)) }

    /// An iteration over a session's outputs.
    public struct Iterator: AsyncIteratorProtocol {
      let cursor: OutputBuffer.Cursor

      /// Waits for the next output; nil if the session was deallocated or the task was canceled.
      public mutating func next() async throws -> Output? { await cursor.next() }
    }
  }
}
