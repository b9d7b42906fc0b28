import Foundation

extension Publisher {
  /// Calls closures with each value and on completion, until the returned handle is released.
  public func sink(
    receiveCompletion: @escaping (Subscribers.Completion<Failure>) -> Void,
    receiveValue: @escaping (Output) -> Void
  ) -> AnyCancellable {
    let holder = SubscriptionHolder()
    receive(
      subscriber: ClosureSubscriber(
        begin: { subscription in
          holder.set(subscription)
          subscription.request(.unlimited)
        },
        take: { value in
          guard !holder.isCancelled else { return .none }
          receiveValue(value)
          return .none
        },
        end: { completion in
          guard !holder.isCancelled else { return }
          receiveCompletion(completion)
        }))
    return AnyCancellable { holder.cancel() }
  }
}

extension Publisher where Failure == Never {
  /// Calls a closure with each value, until the returned handle is released.
  public func sink(receiveValue: @escaping (Output) -> Void) -> AnyCancellable {
    sink(receiveCompletion: { _ in }, receiveValue: receiveValue)
  }

  /// Assigns each value to a property, until the returned handle is released.
  public func assign<Root: AnyObject>(
    to keyPath: ReferenceWritableKeyPath<Root, Output>, on object: Root
  ) -> AnyCancellable { sink { object[keyPath: keyPath] = $0 } }

  /// The values as an asynchronous sequence.
  public var values: AsyncStream<Output> {
    AsyncStream { continuation in
      let handle = sink(
        receiveCompletion: { _ in continuation.finish() },
        receiveValue: { value in
          nonisolated(unsafe) let value = value
          continuation.yield(value)
        })
      continuation.onTermination = { _ in handle.cancel() }
    }
  }
}

/// A subscriber made of closures.
struct ClosureSubscriber<Input, Failure: Error>: Subscriber {
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

/// Holds a subscription until it is canceled or ends.
final class SubscriptionHolder: @unchecked Sendable {
  private let lock = NSLock()
  private var subscription: (any Subscription)?
  private var wasCancelled = false

  var isCancelled: Bool { lock.withLock { wasCancelled } }

  func set(_ subscription: any Subscription) { lock.withLock { self.subscription = subscription } }

  /// Requests values of the subscription while there is one.
  func request(_ demand: Subscribers.Demand) {
    guard demand > .none else { return }
    lock.withLock { subscription }?.request(demand)
  }

  func release() { lock.withLock { subscription = nil } }

  func cancel() {
    let subscription = lock.withLock {
      wasCancelled = true
      defer { self.subscription = nil }
      return self.subscription
    }
    subscription?.cancel()
  }
}
