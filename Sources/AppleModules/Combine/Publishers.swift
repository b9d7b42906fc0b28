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
    let subscription = SingleValueSubscription(subscriber)
    subscriber.receive(subscription: subscription)
    subscription.fulfill(.success(output))
  }
}

/// Publishes one value that becomes available later, or a failure.
public final class Future<Output, Failure: Error>: Publisher, @unchecked Sendable {
  /// Fulfills the future with a value or an error.
  public typealias Promise = (Swift.Result<Output, Failure>) -> Void

  private let state = State()

  /// Creates a future and runs `attemptToFulfill` immediately. Only the first call of the promise
  /// has an effect.
  public init(_ attemptToFulfill: @escaping (@escaping Promise) -> Void) {
    let state = state
    attemptToFulfill { result in
      for subscription in state.fulfill(result) { subscription.fulfill(result) }
    }
  }

  /// Attaches a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    let subscription = SingleValueSubscription(subscriber)
    subscriber.receive(subscription: subscription)
    if let result = state.add(subscription) { subscription.fulfill(result) }
  }

  /// The result, and the subscriptions that wait for it.
  private final class State: @unchecked Sendable {
    private let lock = NSLock()
    private var result: Swift.Result<Output, Failure>?
    private var waiting: [SingleValueSubscription<Output, Failure>] = []

    /// The result; nil where the subscription has to wait.
    func add(
      _ subscription: SingleValueSubscription<Output, Failure>
    ) -> Swift.Result<Output, Failure>? {
      lock.withLock {
        if result == nil { waiting.append(subscription) }
        return result
      }
    }

    /// The subscriptions that waited for the result; none for a second result.
    func fulfill(
      _ result: Swift.Result<Output, Failure>
    ) -> [SingleValueSubscription<Output, Failure>] {
      lock.withLock {
        guard self.result == nil else { return [] }
        self.result = result
        defer { waiting = [] }
        return waiting
      }
    }
  }
}

/// Delivers one value and the completion once both the value and a demand for it exist, or a
/// failure without demand.
private final class SingleValueSubscription<Output, Failure: Error>: Subscription,
  @unchecked Sendable
{
  private let lock = NSLock()
  private var subscriber: ClosureSubscriber<Output, Failure>?
  private var result: Swift.Result<Output, Failure>?
  private var hasDemand = false
  private var isCancelled = false

  init(_ subscriber: some Subscriber<Output, Failure>) {
    self.subscriber = ClosureSubscriber(subscriber)
  }

  func request(_ demand: Subscribers.Demand) {
    lock.withLock { hasDemand = hasDemand || demand > .none }
    deliver()
  }

  func fulfill(_ result: Swift.Result<Output, Failure>) {
    lock.withLock { self.result = result }
    deliver()
  }

  func cancel() { lock.withLock { (subscriber, isCancelled) = (nil, true) } }

  private func deliver() {
    let delivery = lock.withLock {
      () -> (ClosureSubscriber<Output, Failure>, Swift.Result<Output, Failure>)? in
      guard let subscriber, let result else { return nil }
      if case .success = result, !hasDemand { return nil }
      self.subscriber = nil
      return (subscriber, result)
    }
    guard let (subscriber, result) = delivery else { return }
    switch result {
    case .success(let value):
      _ = subscriber.receive(value)
      if !lock.withLock({ isCancelled }) { subscriber.receive(completion: .finished) }
    case .failure(let error): subscriber.receive(completion: .failure(error))
    }
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

/// Delivers a publisher's values on a scheduler, in their order.
private struct ReceiveOnPublisher<Upstream: Publisher, Context: Scheduler>: Publisher {
  typealias Output = Upstream.Output
  typealias Failure = Upstream.Failure

  let upstream: Upstream
  let scheduler: Context

  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    let holder = SubscriptionHolder()
    upstream.receive(
      subscriber: ClosureSubscriber(
        begin: {
          holder.set($0)
          subscriber.receive(subscription: $0)
        },
        take: { value in
          // The subscriber returns its demand later, on the scheduler.
          scheduler.schedule { holder.request(subscriber.receive(value)) }
          return .none
        },
        end: { completion in
          scheduler.schedule {
            holder.release()
            subscriber.receive(completion: completion)
          }
        }))
  }
}
