import Combine
import Testing

@Suite struct PassthroughSubjectTests {
  @Test func subscribersReceiveOnlyLaterValues() {
    let subject = PassthroughSubject<Int, Never>()
    subject.send(1)
    let recorder = RecordingSubscriber<Int, Never>(.unlimited)
    subject.receive(subscriber: recorder)
    subject.send(2)
    subject.send(3)
    #expect(recorder.values == [2, 3] && recorder.completions.isEmpty)
  }

  @Test func valuesWithoutDemandAreDropped() {
    let subject = PassthroughSubject<Int, Never>()
    let recorder = RecordingSubscriber<Int, Never>(.none)
    subject.receive(subscriber: recorder)
    subject.send(1)
    recorder.subscription?.request(.max(2))
    #expect(recorder.values.isEmpty)
    for value in 2...5 { subject.send(value) }
    #expect(recorder.values == [2, 3])
    recorder.subscription?.request(.unlimited)
    subject.send(6)
    #expect(recorder.values == [2, 3, 6])
  }

  @Test func returnedDemandAddsToWhatIsLeft() {
    let subject = PassthroughSubject<Int, Never>()
    // Two values at first, and two more after the first value.
    let recorder = RecordingSubscriber<Int, Never>(.max(2)) { $0 == 1 ? .max(2) : .none }
    subject.receive(subscriber: recorder)
    for value in 1...9 { subject.send(value) }
    #expect(recorder.values == [1, 2, 3, 4])
  }

  @Test func completionNeedsNoDemandAndEndsEverything() {
    let subject = PassthroughSubject<Int, SampleError>()
    let recorder = RecordingSubscriber<Int, SampleError>(.none)
    subject.receive(subscriber: recorder)
    subject.send(completion: .failure(SampleError(code: 4)))
    recorder.subscription?.request(.unlimited)
    subject.send(1)
    subject.send(completion: .finished)
    #expect(recorder.values.isEmpty)
    #expect(recorder.completions == [.failure(SampleError(code: 4))])
  }

  @Test func lateSubscribersReceiveTheFirstCompletion() {
    let subject = PassthroughSubject<Int, SampleError>()
    subject.send(completion: .failure(SampleError(code: 1)))
    subject.send(completion: .finished)
    let recorder = RecordingSubscriber<Int, SampleError>(.unlimited)
    subject.receive(subscriber: recorder)
    #expect(recorder.subscription != nil)
    #expect(recorder.completions == [.failure(SampleError(code: 1))])
  }

  @Test func subscribersAreServedInTheOrderOfSubscription() {
    let subject = PassthroughSubject<Int, Never>()
    var log: [String] = []
    let handles = ["a", "b", "c"].map { name in
      subject.sink(
        receiveCompletion: { _ in log.append("\(name) ends") },
        receiveValue: { log.append("\(name)\($0)") })
    }
    subject.send(1)
    subject.send(2)
    subject.send(completion: .finished)
    #expect(log == ["a1", "b1", "c1", "a2", "b2", "c2", "a ends", "b ends", "c ends"])
    withExtendedLifetime(handles) {}
  }

  @Test func canceledSubscriptionsReceiveNothing() {
    let subject = PassthroughSubject<Int, Never>()
    let canceled = RecordingSubscriber<Int, Never>(.unlimited)
    let other = RecordingSubscriber<Int, Never>(.unlimited)
    subject.receive(subscriber: canceled)
    subject.receive(subscriber: other)
    subject.send(1)
    canceled.subscription?.cancel()
    canceled.subscription?.request(.max(5))
    subject.send(2)
    subject.send(completion: .finished)
    #expect(canceled.values == [1] && canceled.completions.isEmpty)
    #expect(other.values == [1, 2] && other.completions == [.finished])
  }

  @Test func cancellationDuringDeliveryStopsTheRest() {
    let subject = PassthroughSubject<Int, Never>()
    var (values, didEnd) = ([Int](), false)
    var handle: AnyCancellable?
    handle = subject.sink(
      receiveCompletion: { _ in didEnd = true },
      receiveValue: {
        values.append($0)
        if $0 == 2 { handle?.cancel() }
      })
    for value in 1...4 { subject.send(value) }
    subject.send(completion: .finished)
    #expect(values == [1, 2] && !didEnd)
  }

  @Test func valuesSentDuringDeliveryArrive() {
    let subject = PassthroughSubject<Int, Never>()
    var values: [Int] = []
    let handle = subject.sink {
      values.append($0)
      if $0 < 4 { subject.send($0 + 1) }
    }
    subject.send(1)
    #expect(values == [1, 2, 3, 4])
    handle.cancel()
  }

  @Test func concurrentValuesAllArrive() async {
    let subject = PassthroughSubject<Int, Never>()
    let sum = LockedSum()
    let handle = subject.sink { sum.add($0) }
    await withTaskGroup(of: Void.self) { group in
      for _ in 0..<4 { group.addTask { for _ in 0..<500 { subject.send(1) } } }
    }
    handle.cancel()
    #expect(sum.value == 2000)
  }

  @Test func voidSubjectsSendWithoutArguments() {
    let subject = PassthroughSubject<Void, Never>()
    var count = 0
    let handle = subject.sink { count += 1 }
    subject.send()
    subject.send()
    handle.cancel()
    subject.send()
    #expect(count == 2)
  }
}

@Suite struct CurrentValueSubjectTests {
  @Test func subscriptionBeginsWithTheCurrentValue() {
    let subject = CurrentValueSubject<Int, Never>(1)
    subject.send(2)
    let recorder = RecordingSubscriber<Int, Never>(.unlimited)
    subject.receive(subscriber: recorder)
    subject.value = 3
    #expect(recorder.values == [2, 3] && subject.value == 3)
  }

  @Test func theValueChangesBeforeItIsDelivered() {
    let subject = CurrentValueSubject<Int, Never>(1)
    var seen: [[Int]] = []
    let handle = subject.sink { seen.append([$0, subject.value]) }
    subject.send(5)
    #expect(seen == [[1, 1], [5, 5]])
    handle.cancel()
  }

  @Test func lateDemandReceivesTheLatestValue() {
    let subject = CurrentValueSubject<Int, Never>(1)
    let recorder = RecordingSubscriber<Int, Never>(.none)
    subject.receive(subscriber: recorder)
    subject.send(2)
    subject.send(3)
    #expect(recorder.values.isEmpty)
    recorder.subscription?.request(.max(1))
    #expect(recorder.values == [3])
    subject.send(4)
    subject.send(5)
    recorder.subscription?.request(.max(2))
    #expect(recorder.values == [3, 5])
    // One of the two is left.
    subject.send(6)
    subject.send(7)
    #expect(recorder.values == [3, 5, 6])
  }

  @Test func completionFreezesTheValue() {
    let subject = CurrentValueSubject<Int, SampleError>(1)
    subject.send(completion: .finished)
    subject.send(2)
    subject.value = 3
    #expect(subject.value == 1)
    let recorder = RecordingSubscriber<Int, SampleError>(.unlimited)
    subject.receive(subscriber: recorder)
    #expect(recorder.values.isEmpty && recorder.completions == [.finished])
  }

  @Test func optionalValuesArriveAsNil() {
    let subject = CurrentValueSubject<Int?, Never>(nil)
    let recorder = RecordingSubscriber<Int?, Never>(.unlimited)
    subject.receive(subscriber: recorder)
    subject.send(1)
    subject.send(nil)
    #expect(recorder.values == [nil, 1, nil])
  }
}
