import Foundation

/// A type-erased publisher.
public struct AnyPublisher<Output, Failure: Error>: Publisher {
  private let subscribe: (ClosureSubscriber<Output, Failure>) -> Void

  /// Erases the type of a publisher.
  public init(_ publisher: some Publisher<Output, Failure>) {
    subscribe = { publisher.receive(subscriber: $0) }
  }

  /// Attaches a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    subscribe(ClosureSubscriber(subscriber))
  }
}

/// Publishes one value and completes.
public struct Just<Output>: Publisher {
  /// The publisher never fails.
  public typealias Failure = Never
  /// The value.
  public let output: Output

  /// Creates a publisher of a value.
  public init(_ output: Output) { self.output = output }

  /// Attaches a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Never {
    let subject = CurrentValueSubject<Output, Never>(output)
    subject.receive(subscriber: subscriber)
    subject.send(completion: .finished)
  }
}

/// Publishes one value that becomes available later, or a failure.
public final class Future<Output, Failure: Error>: Publisher, @unchecked Sendable {
  /// Fulfills the future with a value or an error.
  public typealias Promise = (Swift.Result<Output, Failure>) -> Void

  private let subject = CurrentValueSubject<Output?, Failure>(nil)

  /// Creates a future and runs `attemptToFulfill` immediately.
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

  /// Attaches a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    subject.compactMap { $0 }.receive(subscriber: subscriber)
  }
}

/// Publishes a transformed value for each upstream value, or none.
struct TransformPublisher<Upstream: Publisher, Output>: Publisher {
  typealias Failure = Upstream.Failure

  let upstream: Upstream
  /// Makes a function for each subscriber; it may capture state.
  let step: () -> (Upstream.Output) -> Output?

  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    let step = step()
    upstream.receive(
      subscriber: ClosureSubscriber(
        begin: subscriber.receive(subscription:),
        take: { step($0).map { subscriber.receive($0) } ?? .max(1) },
        end: subscriber.receive(completion:)))
  }
}

extension Publisher {
  /// Erases the type of the publisher.
  public func eraseToAnyPublisher() -> AnyPublisher<Output, Failure> { AnyPublisher(self) }

  /// Transforms each value.
  public func map<T>(_ transform: @escaping (Output) -> T) -> some Publisher<T, Failure> {
    TransformPublisher(upstream: self) { { transform($0) } }
  }

  /// Publishes a property of each value.
  public func map<T>(_ keyPath: KeyPath<Output, T>) -> some Publisher<T, Failure> {
    TransformPublisher(upstream: self) { { $0[keyPath: keyPath] } }
  }

  /// Transforms each value and drops nil results.
  public func compactMap<T>(
    _ transform: @escaping (Output) -> T?
  ) -> some Publisher<T, Failure> { TransformPublisher(upstream: self) { transform } }

  /// Publishes the values that satisfy a predicate.
  public func filter(
    _ isIncluded: @escaping (Output) -> Bool
  ) -> some Publisher<Output, Failure> {
    TransformPublisher(upstream: self) { { isIncluded($0) ? $0 : nil } }
  }

  /// Drops the first `count` values.
  public func dropFirst(_ count: Int = 1) -> some Publisher<Output, Failure> {
    TransformPublisher(upstream: self) {
      var left = count
      return { value in
        guard left > 0 else { return value }
        left -= 1
        return nil
      }
    }
  }

  /// Accumulates values: each result is computed from the previous one and the next value.
  public func scan<T>(
    _ initialResult: T, _ nextPartialResult: @escaping (T, Output) -> T
  ) -> some Publisher<T, Failure> {
    TransformPublisher(upstream: self) {
      var result = initialResult
      return { value in
        result = nextPartialResult(result, value)
        return result
      }
    }
  }

  /// Delivers values on a queue or run loop.
  public func receive(on scheduler: some Scheduler) -> some Publisher<Output, Failure> {
    ReceiveOnPublisher(upstream: self, scheduler: scheduler)
  }
}

extension Publisher where Output: Equatable {
  /// Drops values that equal their predecessor.
  public func removeDuplicates() -> some Publisher<Output, Failure> {
    TransformPublisher(upstream: self) {
      var last: Output?
      return { value in
        defer { last = value }
        return value == last ? nil : value
      }
    }
  }
}

/// Delivers a publisher's values on a scheduler, in order.
private struct ReceiveOnPublisher<Upstream: Publisher, Context: Scheduler>: Publisher {
  typealias Output = Upstream.Output
  typealias Failure = Upstream.Failure

  let upstream: Upstream
  let scheduler: Context

  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    upstream.receive(
      subscriber: ClosureSubscriber(
        begin: subscriber.receive(subscription:),
        take: { value in
          scheduler.schedule { _ = subscriber.receive(value) }
          // The subscriber's demand is known only later, so it is not counted.
          return .max(1)
        },
        end: { completion in scheduler.schedule { subscriber.receive(completion: completion) } }))
  }
}
