import Combine
import Dispatch
import Testing

@Suite struct OperatorTests {
  private let subject = PassthroughSubject<Int, SampleError>()

  private func values<P: Publisher>(
    of publisher: P, sending values: [Int]
  ) -> [P.Output] where P.Failure == SampleError {
    let recorder = RecordingSubscriber<P.Output, SampleError>(.unlimited)
    publisher.receive(subscriber: recorder)
    for value in values { subject.send(value) }
    subject.send(completion: .failure(SampleError(code: 9)))
    #expect(recorder.completions == [.failure(SampleError(code: 9))])
    return recorder.values
  }

  @Test func mapTransformsEachValue() {
    #expect(values(of: subject.map { "\($0 * 2)" }, sending: [1, 2]) == ["2", "4"])
  }

  @Test func mapFollowsAKeyPath() {
    #expect(values(of: subject.map(\.bitWidth), sending: [1, 2]) == [64, 64])
  }

  @Test func compactMapLeavesOutNil() {
    let halves = subject.compactMap { $0 % 2 == 0 ? $0 / 2 : nil }
    #expect(values(of: halves, sending: [1, 2, 3, 8]) == [1, 4])
  }

  @Test func filterKeepsTheIncluded() {
    #expect(values(of: subject.filter { $0 > 1 }, sending: [1, 2, 0, 3]) == [2, 3])
  }

  @Test func dropFirstLeavesOutTheFirst() {
    #expect(values(of: subject.dropFirst(), sending: [1, 2, 3]) == [2, 3])
  }

  @Test(arguments: [(0, [1, 2, 3]), (2, [3]), (5, [])] as [(Int, [Int])]) func dropFirstCounts(
    count: Int, expected: [Int]
  ) { #expect(values(of: subject.dropFirst(count), sending: [1, 2, 3]) == expected) }

  @Test func scanAccumulates() {
    #expect(values(of: subject.scan(10, -), sending: [1, 2, 3]) == [9, 7, 4])
  }

  @Test func removeDuplicatesComparesNeighbors() {
    let sent = [1, 1, 2, 2, 1, 3, 3]
    #expect(values(of: subject.removeDuplicates(), sending: sent) == [1, 2, 1, 3])
  }

  @Test func removeDuplicatesDeliversALeadingNil() {
    let source = PassthroughSubject<Int?, Never>()
    let recorder = RecordingSubscriber<Int?, Never>(.unlimited)
    source.removeDuplicates().receive(subscriber: recorder)
    for value in [nil, nil, 1, nil] as [Int?] { source.send(value) }
    #expect(recorder.values == [nil, 1, nil])
  }

  @Test func eachSubscriberHasItsOwnState() {
    let sums = subject.scan(0, +).eraseToAnyPublisher()
    let first = RecordingSubscriber<Int, SampleError>(.unlimited)
    sums.receive(subscriber: first)
    subject.send(1)
    let second = RecordingSubscriber<Int, SampleError>(.unlimited)
    sums.receive(subscriber: second)
    subject.send(2)
    #expect(first.values == [1, 3] && second.values == [2])
  }

  @Test func valuesLeftOutDoNotUseUpDemand() {
    let recorder = RecordingSubscriber<Int, SampleError>(.max(2))
    subject.filter { $0 % 2 == 0 }.map { $0 * 10 }.receive(subscriber: recorder)
    for value in 1...9 { subject.send(value) }
    #expect(recorder.values == [20, 40])
  }

  @Test func erasedPublishersKeepDemandAndCancellation() {
    let recorder = RecordingSubscriber<Int, SampleError>(.max(1))
    subject.eraseToAnyPublisher().receive(subscriber: recorder)
    subject.send(1)
    subject.send(2)
    recorder.subscription?.request(.max(1))
    subject.send(3)
    recorder.subscription?.cancel()
    subject.send(completion: .finished)
    #expect(recorder.values == [1, 3] && recorder.completions.isEmpty)
  }

  @Test func receiveOnKeepsDemand() {
    let recorder = RecordingSubscriber<Int, SampleError>(.max(1)) { $0 == 1 ? .max(1) : .none }
    subject.receive(on: ImmediateScheduler.shared).receive(subscriber: recorder)
    for value in 1...5 { subject.send(value) }
    #expect(recorder.values == [1, 2])
    recorder.subscription?.request(.max(1))
    subject.send(6)
    subject.send(7)
    #expect(recorder.values == [1, 2, 6])
  }

  @Test func receiveOnKeepsTheOrderOnAnotherThread() async {
    let queue = DispatchQueue(label: "receiver")
    let (stream, continuation) = AsyncStream.makeStream(of: String.self)
    let handle = subject.receive(on: queue).sink(
      receiveCompletion: {
        dispatchPrecondition(condition: .onQueue(queue))
        continuation.yield("\($0 == .finished)")
        continuation.finish()
      },
      receiveValue: {
        dispatchPrecondition(condition: .onQueue(queue))
        continuation.yield("\($0)")
      })
    for value in 1...20 { subject.send(value) }
    subject.send(completion: .finished)
    var received: [String] = []
    for await value in stream { received.append(value) }
    #expect(received == (1...20).map { "\($0)" } + ["true"])
    handle.cancel()
  }
}

@Suite struct DemandTests {
  @Test func demandsAddUp() {
    #expect(Subscribers.Demand.max(2) + .max(3) == .max(5))
    #expect(Subscribers.Demand.max(2) + .unlimited == .unlimited)
    #expect(Subscribers.Demand.none == .max(0) && Subscribers.Demand.unlimited.max == nil)
  }

  @Test func sumsBeyondTheLargestIntegerAreUnlimited() {
    #expect(Subscribers.Demand.max(.max) + .max(1) == .unlimited)
  }

  @Test func unlimitedIsTheLargest() {
    #expect(Subscribers.Demand.unlimited > .max(.max))
    #expect(!(Subscribers.Demand.unlimited < .unlimited))
    #expect(Subscribers.Demand.none < .max(1) && Subscribers.Demand.max(3) > .max(2))
  }
}
