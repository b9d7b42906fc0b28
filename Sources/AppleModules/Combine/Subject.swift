import Foundation

/// A publisher that code can send values through.
public protocol Subject<Output, Failure>: AnyObject, Publisher {
  /// Sends a value to the subscribers.
  func send(_ value: Output)
  /// Sends the completion; no values follow.
  func send(completion: Subscribers.Completion<Failure>)
}

extension Subject where Output == Void {
  /// Sends an event without a value.
  public func send() { send(()) }
}

/// Sends values to its current subscribers and keeps none of them.
public final class PassthroughSubject<Output, Failure: Error>: Subject, @unchecked Sendable {
  private let core = SubscriptionList<Output, Failure>()

  /// Creates a subject.
  public init() {}

  /// Attaches a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    core.add(subscriber)
  }

  /// Sends a value to the subscribers.
  public func send(_ value: Output) { core.send(value) }

  /// Sends the completion; no values follow.
  public func send(completion: Subscribers.Completion<Failure>) { core.send(completion) }
}

/// A subject that keeps its latest value and sends it to new subscribers first.
public final class CurrentValueSubject<Output, Failure: Error>: Subject, @unchecked Sendable {
  private let core = SubscriptionList<Output, Failure>()
  private let lock = NSLock()
  private var current: Output

  /// Creates a subject with an initial value.
  public init(_ value: Output) { current = value }

  /// The current value; setting it publishes it.
  public var value: Output {
    get { lock.withLock { current } }
    set { send(newValue) }
  }

  /// Attaches a subscriber; it receives the current value first.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure {
    core.add(subscriber, value: value)
  }

  /// Stores a value and sends it to the subscribers.
  public func send(_ value: Output) {
    guard !core.isFinished else { return }
    lock.withLock { current = value }
    core.send(value)
  }

  /// Sends the completion; no values follow.
  public func send(completion: Subscribers.Completion<Failure>) { core.send(completion) }
}

/// The subscriptions of a subject, thread-safe.
private final class SubscriptionList<Output, Failure: Error>: @unchecked Sendable {
  private let lock = NSLock()
  private var members: [ObjectIdentifier: SubjectSubscription<Output, Failure>] = [:]
  private var order: [ObjectIdentifier] = []
  private var end: Subscribers.Completion<Failure>?

  var isFinished: Bool { lock.withLock { end != nil } }

  func add<S: Subscriber>(_ subscriber: S) where S.Input == Output, S.Failure == Failure {
    add(subscriber, SubjectSubscription(subscriber.receive, subscriber.receive(completion:)))
  }

  /// Adds a subscriber that receives the current value first, and the latest one whenever it
  /// requests values after it had no demand.
  func add<S: Subscriber>(_ subscriber: S, value: Output)
  where S.Input == Output, S.Failure == Failure {
    let member = SubjectSubscription(
      subscriber.receive, subscriber.receive(completion:), latest: value)
    add(subscriber, member)
  }

  private func add(_ subscriber: some Subscriber, _ member: SubjectSubscription<Output, Failure>) {
    let id = ObjectIdentifier(member)
    member.onCancel = { [weak self] in self?.remove(id) }
    let end = lock.withLock {
      if self.end == nil {
        members[id] = member
        order.append(id)
      }
      return self.end
    }
    if end != nil { member.dropLatest() }
    subscriber.receive(subscription: member)
    if let end { member.finish(end) }
  }

  func send(_ value: Output) { for member in current() { member.send(value) } }

  func send(_ completion: Subscribers.Completion<Failure>) {
    let members = current()
    lock.withLock {
      end = end ?? completion
      self.members = [:]
      order = []
    }
    for member in members { member.finish(completion) }
  }

  private func current() -> [SubjectSubscription<Output, Failure>] {
    lock.withLock { order.compactMap { members[$0] } }
  }

  private func remove(_ id: ObjectIdentifier) {
    lock.withLock {
      members[id] = nil
      order.removeAll { $0 == id }
    }
  }
}

/// One subscriber of a subject with its remaining demand. A value without demand is dropped, or
/// kept until the next request if the subscriber receives the latest value.
private final class SubjectSubscription<Output, Failure: Error>: Subscription, @unchecked Sendable {
  private let lock = NSRecursiveLock()
  private var demand = Subscribers.Demand.none
  private let keepsLatest: Bool
  private var latest: Output?
  private var take: ((Output) -> Subscribers.Demand)?
  private var end: ((Subscribers.Completion<Failure>) -> Void)?
  var onCancel: () -> Void = {}

  init(
    _ take: @escaping (Output) -> Subscribers.Demand,
    _ end: @escaping (Subscribers.Completion<Failure>) -> Void
  ) { (self.take, self.end, keepsLatest) = (take, end, false) }

  init(
    _ take: @escaping (Output) -> Subscribers.Demand,
    _ end: @escaping (Subscribers.Completion<Failure>) -> Void, latest: Output
  ) { (self.take, self.end, self.latest, keepsLatest) = (take, end, latest, true) }

  func request(_ demand: Subscribers.Demand) {
    let waiting: Output? = lock.withLock {
      self.demand = self.demand + demand
      guard self.demand > .none else { return nil }
      defer { latest = nil }
      return latest
    }
    if let waiting { send(waiting) }
  }

  func send(_ value: Output) {
    let take = lock.withLock { () -> ((Output) -> Subscribers.Demand)? in
      guard demand > .none else {
        if keepsLatest { latest = value }
        return nil
      }
      if let count = demand.max { demand = .max(count - 1) }
      latest = nil
      return self.take
    }
    guard let more = take?(value) else { return }
    request(more)
  }

  func finish(_ completion: Subscribers.Completion<Failure>) {
    let end = lock.withLock {
      defer { (self.end, take) = (nil, nil) }
      return self.end
    }
    end?(completion)
  }

  func dropLatest() { lock.withLock { latest = nil } }

  func cancel() {
    lock.withLock { (take, end) = (nil, nil) }
    onCancel()
  }
}
