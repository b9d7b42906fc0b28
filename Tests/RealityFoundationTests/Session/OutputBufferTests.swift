import Testing

@testable import RealityFoundation

@Suite(.timeLimit(.minutes(10))) struct OutputBufferTests {
  typealias Output = PhotogrammetrySession.Output

  private func id(_ output: Output?) -> Int? {
    if case .skippedSample(let id) = output { id } else { nil }
  }

  @Test func outputsAreBufferedForTheFirstReader() async {
    let buffer = OutputBuffer()
    for id in 0..<1000 { buffer.append(.skippedSample(id: id)) }
    buffer.finish()
    let cursor = OutputBuffer.Cursor(buffer)
    for expected in 0..<1000 { #expect(id(await cursor.next()) == expected) }
    #expect(await cursor.next() == nil)
    #expect(await cursor.next() == nil)
  }

  @Test func laterReaderStartsAtTheMostAdvancedPosition() async {
    let buffer = OutputBuffer()
    for id in 0..<200 { buffer.append(.skippedSample(id: id)) }
    do {
      let first = OutputBuffer.Cursor(buffer)
      for _ in 0..<150 { _ = await first.next() }
    }
    let second = OutputBuffer.Cursor(buffer)
    #expect(id(await second.next()) == 150)
  }

  @Test func concurrentReadersReceiveTheSameOutputs() async {
    let buffer = OutputBuffer()
    let cursors = (0..<3).map { _ in OutputBuffer.Cursor(buffer) }
    let readers = cursors.map { cursor in
      Task {
        var ids: [Int] = []
        while let output = await cursor.next() { ids.append(id(output) ?? -1) }
        return ids
      }
    }
    for id in 0..<300 {
      buffer.append(.skippedSample(id: id))
      if id % 50 == 0 { await Task.yield() }
    }
    buffer.finish()
    for reader in readers { #expect(await reader.value == Array(0..<300)) }
  }

  @Test func canceledTaskStopsWaiting() async {
    let buffer = OutputBuffer()
    let task = Task { await OutputBuffer.Cursor(buffer).next() == nil }
    await Task.yield()
    task.cancel()
    #expect(await task.value)
  }

  @Test func nothingIsAddedAfterTheEnd() async {
    let buffer = OutputBuffer()
    let waiting = Task { await OutputBuffer.Cursor(buffer).next() == nil }
    await Task.yield()
    buffer.finish()
    buffer.append(.inputComplete)
    #expect(await waiting.value)
    #expect(await OutputBuffer.Cursor(buffer).next() == nil)
  }
}
