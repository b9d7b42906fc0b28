import Combine
import Foundation

private final class Progress: ObservableObject {
  @Published var fraction = 0.0
  @Published var stage = ""
  var seen: [Int] = []
}

/// A subscriber that requests one value at a time and at most two.
private final class Pair: Subscriber {
  typealias Input = Int
  typealias Failure = Never

  var values: [Int] = []

  func receive(subscription: any Subscription) { subscription.request(.max(1)) }
  func receive(_ input: Int) -> Subscribers.Demand {
    values.append(input)
    return values.count < 2 ? .max(1) : .none
  }
  func receive(completion: Subscribers.Completion<Never>) { values.append(-1) }
}

/// Uses publishers and subscribers.
func usePublishers() async {
  let progress = Progress()
  var handles = Set<AnyCancellable>()
  var changes = 0
  progress.objectWillChange.sink { changes += 1 }.store(in: &handles)
  progress.$fraction.map { Int($0 * 100) }.removeDuplicates().filter { $0 > 0 }
    .sink { progress.seen.append($0) }.store(in: &handles)
  progress.fraction = 0.5
  progress.fraction = 0.5
  progress.fraction = 1
  check(changes == 3 && progress.seen == [50, 100] && progress.fraction == 1, "published")
  let names = PassthroughSubject<String?, Never>()
  let known: AnyPublisher<Bool, Never> = names.map { $0 != nil }.eraseToAnyPublisher()
  known.sink { check($0 == (progress.stage != "nobody"), "in order") }.store(in: &handles)
  names.compactMap { $0 }.dropFirst().assign(to: \.stage, on: progress).store(in: &handles)
  for name in ["a", "x", "b"] { publish(name, by: names) }
  check(progress.stage == "b", "assigned")
  Just("c").assign(to: &progress.$stage)
  check(progress.stage == "c", "followed")

  let numbers = CurrentValueSubject<Int, Never>(1)
  let pair = Pair()
  numbers.receive(subscriber: pair)
  for number in 2...4 { numbers.send(number) }
  numbers.send(completion: .finished)
  check(pair.values == [1, 2, -1] && numbers.value == 4, "at most the demand")
  check(Subscribers.Demand.unlimited > .max(3) && (Subscribers.Demand.none + .max(2)).max == 2, "")

  struct Failed: Error {}
  let future = Future<Int, any Error> { (promise: Future<Int, any Error>.Promise) in
    promise(.failure(Failed()))
  }
  var failure: (any Error)?
  let handle = future.scan(0, +).receive(on: ImmediateScheduler.shared).eraseToAnyPublisher().sink(
    receiveCompletion: { if case .failure(let error) = $0 { failure = error } },
    receiveValue: { _ in })
  check(failure is Failed, "failed")
  (handle as any Cancellable).cancel()
  var sum = 0
  for await value in Just(5).eraseToAnyPublisher().values { sum += value }
  check(sum == 5, "awaited")
  _ = schedule(on: DispatchQueue.main)
}

private func publish(_ name: String?, by subject: some Subject<String?, Never>) {
  subject.send(name)
}

/// Publishers of any type can be passed on.
private func schedule(on queue: some Scheduler) -> any Publisher<Int, Never> {
  Just(1).receive(on: queue)
}
