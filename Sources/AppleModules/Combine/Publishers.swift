import Foundation

/// A publisher whose kind doesn't matter.
public struct AnyPublisher<Output, Failure: Error>: Publisher {
  private let subscribe: (Relay<Output, Failure>) -> Void

  /// Hides the kind of a publisher.
  public init(_ publisher: some Publisher<Output, Failure>) {
    subscribe = { publisher.receive(subscriber: $0) }
  }

  /// Begins to tell a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    subscribe(Relay(subscriber))
  }
}

/// Tells one value.
public struct Just<Output>: Publisher {
  /// There is no failure.
  public typealias Failure = Never
  /// The value.
  public let output: Output

  /// Creates a publisher of a value.
  public init(_ output: Output) { self.output = output }

  /// Begins to tell a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Never {
    let subject = CurrentValueSubject<Output, Never>(output)
    subject.receive(subscriber: subscriber)
    subject.send(completion: .finished)
  }
}

/// Tells one value that is not there yet, or why there is none.
public final class Future<Output, Failure: Error>: Publisher, @unchecked Sendable {
  /// Is called with the value.
  public typealias Promise = (Swift.Result<Output, Failure>) -> Void

  private let subject = CurrentValueSubject<Output?, Failure>(nil)

  /// Creates a publisher, and begins to work for its value at once.
  public init(_ attemptToFulfill: @escaping (@escaping Promise) -> Void) {
    let subject = subject
    attemptToFulfill { result in
      switch result {
      case .success(let value):
        subject.send(value)
        subject.send(completion: .finished)
      case .failure(let error): subject.send(completion: .failure(error))
      }
    }
  }

  /// Begins to tell a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    subject.compactMap { $0 }.receive(subscriber: subscriber)
  }
}

/// Hands on what it is told.
struct Relay<Input, Failure: Error>: Subscriber {
  let begin: (any Subscription) -> Void
  let take: (Input) -> Subscribers.Demand
  let end: (Subscribers.Completion<Failure>) -> Void

  init(
    begin: @escaping (any Subscription) -> Void, take: @escaping (Input) -> Subscribers.Demand,
    end: @escaping (Subscribers.Completion<Failure>) -> Void
  ) { (self.begin, self.take, self.end) = (begin, take, end) }

  init(_ other: some Subscriber<Input, Failure>) {
    self.init(
      begin: other.receive(subscription:), take: other.receive, end: other.receive(completion:))
  }

  func receive(subscription: any Subscription) { begin(subscription) }
  func receive(_ input: Input) -> Subscribers.Demand { take(input) }
  func receive(completion: Subscribers.Completion<Failure>) { end(completion) }
}

/// Makes other values of a publisher's, or none of some.
struct Transform<Upstream: Publisher, Output>: Publisher {
  typealias Failure = Upstream.Failure

  let upstream: Upstream
  /// Gives a function for each subscriber, which may have a memory.
  let step: () -> (Upstream.Output) -> Output?

  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    let step = step()
    upstream.receive(
      subscriber: Relay(
        begin: subscriber.receive(subscription:),
        take: { step($0).map { subscriber.receive($0) } ?? .max(1) },
        end: subscriber.receive(completion:)))
  }
}

extension Publisher {
  /// Hides the kind of the publisher.
  public func eraseToAnyPublisher() -> AnyPublisher<Output, Failure> { AnyPublisher(self) }

  /// Makes another value of each.
  public func map<T>(_ transform: @escaping (Output) -> T) -> some Publisher<T, Failure> {
    Transform(upstream: self) { { transform($0) } }
  }

  /// Takes a property of each value.
  public func map<T>(_ keyPath: KeyPath<Output, T>) -> some Publisher<T, Failure> {
    Transform(upstream: self) { { $0[keyPath: keyPath] } }
  }

  /// Makes another value of each, or none.
  public func compactMap<T>(
    _ transform: @escaping (Output) -> T?
  ) -> some Publisher<T, Failure> { Transform(upstream: self) { transform } }

  /// Tells the values that meet a condition.
  public func filter(
    _ isIncluded: @escaping (Output) -> Bool
  ) -> some Publisher<Output, Failure> {
    Transform(upstream: self) { { isIncluded($0) ? $0 : nil } }
  }

  /// Leaves out the first values.
  public func dropFirst(_ count: Int = 1) -> some Publisher<Output, Failure> {
    Transform(upstream: self) {
      var left = count
      return { value in
        guard left > 0 else { return value }
        left -= 1
        return nil
      }
    }
  }

  /// Makes a value of each and what was made of the one before.
  public func scan<T>(
    _ initialResult: T, _ nextPartialResult: @escaping (T, Output) -> T
  ) -> some Publisher<T, Failure> {
    Transform(upstream: self) {
      var result = initialResult
      return { value in
        result = nextPartialResult(result, value)
        return result
      }
    }
  }

  /// Tells the values on a queue or run loop.
  public func receive(on scheduler: some Scheduler) -> some Publisher<Output, Failure> {
    Rescheduled(upstream: self, scheduler: scheduler)
  }
}

extension Publisher where Output: Equatable {
  /// Leaves out values that equal the one before.
  public func removeDuplicates() -> some Publisher<Output, Failure> {
    Transform(upstream: self) {
      var last: Output?
      return { value in
        defer { last = value }
        return value == last ? nil : value
      }
    }
  }
}

/// Tells a publisher's values elsewhere, in their order.
private struct Rescheduled<Upstream: Publisher, Context: Scheduler>: Publisher {
  typealias Output = Upstream.Output
  typealias Failure = Upstream.Failure

  let upstream: Upstream
  let scheduler: Context

  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    upstream.receive(
      subscriber: Relay(
        begin: subscriber.receive(subscription:),
        take: { value in
          scheduler.schedule { _ = subscriber.receive(value) }
          // What the subscriber asks for comes too late to be counted.
          return .max(1)
        },
        end: { completion in scheduler.schedule { subscriber.receive(completion: completion) } }))
  }
}
