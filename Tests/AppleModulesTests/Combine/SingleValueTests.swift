import Combine
import Testing

@Suite struct SingleValueTests {
  @Test func justDeliversItsValueAndFinishes() {
    let recorder = RecordingSubscriber<Int, Never>(.unlimited)
    Just(7).receive(subscriber: recorder)
    #expect(recorder.values == [7] && recorder.completions == [.finished])
    #expect(Just("a").output == "a")
  }

  @Test func justWaitsForDemand() {
    let recorder = RecordingSubscriber<Int, Never>(.none)
    Just(7).receive(subscriber: recorder)
    #expect(recorder.values.isEmpty && recorder.completions.isEmpty)
    recorder.subscription?.request(.max(1))
    recorder.subscription?.request(.max(1))
    #expect(recorder.values == [7] && recorder.completions == [.finished])
  }

  @Test func canceledJustDeliversNothing() {
    let recorder = RecordingSubscriber<Int, Never>(.none)
    Just(7).receive(subscriber: recorder)
    recorder.subscription?.cancel()
    recorder.subscription?.request(.unlimited)
    #expect(recorder.values.isEmpty && recorder.completions.isEmpty)
  }

  @Test func futureStartsAtOnceAndDeliversToEverySubscriber() throws {
    var promise: Future<Int, SampleError>.Promise?
    let future = Future<Int, SampleError> { promise = $0 }
    let fulfill = try #require(promise)
    let early = RecordingSubscriber<Int, SampleError>(.unlimited)
    future.receive(subscriber: early)
    #expect(early.values.isEmpty && early.completions.isEmpty)
    fulfill(.success(3))
    #expect(early.values == [3] && early.completions == [.finished])
    let late = RecordingSubscriber<Int, SampleError>(.max(1))
    future.receive(subscriber: late)
    #expect(late.values == [3] && late.completions == [.finished])
  }

  @Test func onlyTheFirstPromiseCounts() {
    let future = Future<Int, SampleError> { promise in
      promise(.success(1))
      promise(.success(2))
      promise(.failure(SampleError(code: 1)))
    }
    let recorder = RecordingSubscriber<Int, SampleError>(.unlimited)
    future.receive(subscriber: recorder)
    #expect(recorder.values == [1] && recorder.completions == [.finished])
  }

  @Test func futureWaitsForDemandButNotToFail() {
    let value = RecordingSubscriber<Int, SampleError>(.none)
    Future<Int, SampleError> { $0(.success(1)) }.receive(subscriber: value)
    #expect(value.values.isEmpty && value.completions.isEmpty)
    value.subscription?.request(.max(1))
    #expect(value.values == [1] && value.completions == [.finished])
    let failure = RecordingSubscriber<Int, SampleError>(.none)
    Future<Int, SampleError> { $0(.failure(SampleError(code: 2))) }.receive(subscriber: failure)
    #expect(failure.completions == [.failure(SampleError(code: 2))])
  }

  @Test func canceledFutureDeliversNothing() throws {
    var promise: Future<Int, Never>.Promise?
    let future = Future<Int, Never> { promise = $0 }
    let recorder = RecordingSubscriber<Int, Never>(.unlimited)
    future.receive(subscriber: recorder)
    recorder.subscription?.cancel()
    let fulfill = try #require(promise)
    fulfill(.success(1))
    #expect(recorder.values.isEmpty && recorder.completions.isEmpty)
  }

  @Test func valuesCanBeAwaited() async {
    let subject = CurrentValueSubject<Int, Never>(1)
    let values = subject.values
    subject.send(2)
    subject.send(completion: .finished)
    var received: [Int] = []
    for await value in values { received.append(value) }
    #expect(received == [1, 2])
  }
}
