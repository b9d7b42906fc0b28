import SceneModel

/// Keeps a session's outputs until they are read.
///
/// Each cursor reads all outputs from its start; a new cursor starts at the most advanced position.
final class OutputBuffer: Sendable {
  typealias Output = PhotogrammetrySession.Output

  private struct Waiter {
    var id: Int
    var cursor: Int
    var continuation: CheckedContinuation<Output?, Never>
  }

  private struct State {
    /// The outputs that a cursor may still read; the first is output number `offset`.
    var kept: [Output] = []
    var offset = 0
    /// The number of the first output that no cursor has read.
    var farthest = 0
    var positions: [Int: Int] = [:]
    var waiters: [Waiter] = []
    var lastID = 0
    var isFinished = false

    mutating func nextID() -> Int {
      lastID += 1
      return lastID
    }

    /// Advances a cursor past the next output; nil if there is none yet.
    mutating func take(_ cursor: Int) -> Output? {
      guard let position = positions[cursor], position - offset < kept.count else { return nil }
      let output = kept[position - offset]
      positions[cursor] = position + 1
      farthest = max(farthest, position + 1)
      dropRead()
      return output
    }

    mutating func dropRead() {
      let read = min(farthest, positions.values.min() ?? farthest) - offset
      guard read >= 64 || read == kept.count else { return }
      kept.removeFirst(read)
      offset += read
    }
  }

  private let state = Locked(State())

  /// Adds an output; has no effect after `finish()`.
  func append(_ output: Output) {
    let ready = state.withLock { state -> [(Waiter, Output)] in
      guard !state.isFinished else { return [] }
      state.kept.append(output)
      let waiters = state.waiters
      state.waiters = []
      var ready: [(Waiter, Output)] = []
      for waiter in waiters {
        if let output = state.take(waiter.cursor) {
          ready.append((waiter, output))
        } else {
          state.waiters.append(waiter)
        }
      }
      return ready
    }
    for (waiter, output) in ready { waiter.continuation.resume(returning: output) }
  }

  /// Ends all iterations after they have read the buffered outputs.
  func finish() {
    let waiters = state.withLock { state -> [Waiter] in
      state.isFinished = true
      defer { state.waiters = [] }
      return state.waiters
    }
    for waiter in waiters { waiter.continuation.resume(returning: nil) }
  }

  /// A position in the outputs, which only advances.
  final class Cursor: Sendable {
    private let buffer: OutputBuffer
    private let id: Int

    init(_ buffer: OutputBuffer) {
      self.buffer = buffer
      id = buffer.state.withLock { state in
        let id = state.nextID()
        state.positions[id] = state.farthest
        return id
      }
    }

    deinit {
      buffer.state.withLock { state in
        state.positions[id] = nil
        state.dropRead()
      }
    }

    /// Waits for the next output; nil at the end or if the task is canceled.
    func next() async -> Output? {
      let waiter = buffer.state.withLock { $0.nextID() }
      return await withTaskCancellationHandler {
        await withCheckedContinuation { continuation in
          buffer.wait(Waiter(id: waiter, cursor: id, continuation: continuation))
        }
      } onCancel: {
        buffer.abandon(waiter)
      }
    }
  }

  private func wait(_ waiter: Waiter) {
    let (answer, output) = state.withLock { state -> (Bool, Output?) in
      // The cancellation handler waits for the lock, so that no cancellation is missed.
      if Task.isCancelled { return (true, nil) }
      if let output = state.take(waiter.cursor) { return (true, output) }
      if state.isFinished { return (true, nil) }
      state.waiters.append(waiter)
      return (false, nil)
    }
    if answer { waiter.continuation.resume(returning: output) }
  }

  private func abandon(_ id: Int) {
    let waiter = state.withLock { state -> Waiter? in
      state.waiters.firstIndex { $0.id == id }.map { state.waiters.remove(at: $0) }
    }
    waiter?.continuation.resume(returning: nil)
  }
}
