@_exported import Foundation

/// Tells values, one after another, until it completes or fails.
///
/// This module has what classes that publish their state need: subjects, `Published`,
/// `ObservableObject`, and the operators beside this declaration.
public protocol Publisher<Output, Failure> {
  /// The type of the values.
  associatedtype Output
  /// The type of the failure; `Never` where there is none.
  associatedtype Failure: Error

  /// Begins to tell a subscriber.
  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure
}

/// Is told values, as many as it asks for.
public protocol Subscriber<Input, Failure> {
  /// The type of the values.
  associatedtype Input
  /// The type of the failure.
  associatedtype Failure: Error

  /// Gets the subscription, to ask it for values.
  func receive(subscription: any Subscription)
  /// Gets a value, and says how many more it asks for.
  func receive(_ input: Input) -> Subscribers.Demand
  /// Gets to know that there are no more values.
  func receive(completion: Subscribers.Completion<Failure>)
}

/// Can be stopped.
public protocol Cancellable {
  /// Stops.
  func cancel()
}

/// Joins a publisher and a subscriber.
public protocol Subscription: Cancellable {
  /// Asks for values.
  func request(_ demand: Subscribers.Demand)
}

/// What subscribers get and ask for.
public enum Subscribers {
  /// How values end.
  public enum Completion<Failure: Error> {
    /// There are no more.
    case finished
    /// Something went wrong.
    case failure(Failure)
  }

  /// How many values are asked for.
  public struct Demand: Hashable, Comparable, Sendable {
    /// The number; nil where there is no limit.
    public let max: Int?

    /// All there are.
    public static let unlimited = Demand(max: nil)
    /// None.
    public static let none = Demand(max: 0)

    /// No more than a number.
    public static func max(_ value: Int) -> Demand { Demand(max: Swift.max(0, value)) }

    /// The sum of two demands.
    public static func + (lhs: Demand, rhs: Demand) -> Demand {
      guard let left = lhs.max, let right = rhs.max else { return .unlimited }
      return .max(left + right)
    }

    /// Whether the first asks for fewer.
    public static func < (lhs: Demand, rhs: Demand) -> Bool {
      (lhs.max ?? .max) < (rhs.max ?? .max)
    }
  }
}

extension Subscribers.Completion: Sendable {}
extension Subscribers.Completion: Equatable where Failure: Equatable {}

/// Stops a subscription when it goes away.
public final class AnyCancellable: Cancellable, Hashable, @unchecked Sendable {
  private let lock = NSLock()
  private var action: (() -> Void)?

  /// Creates a handle that does something when it is cancelled.
  public init(_ cancel: @escaping () -> Void) { action = cancel }

  /// Creates a handle of what can be stopped.
  public convenience init(_ canceller: some Cancellable) { self.init { canceller.cancel() } }

  deinit { action?() }

  /// Stops, the first time.
  public func cancel() {
    let action = lock.withLock {
      defer { self.action = nil }
      return self.action
    }
    action?()
  }

  /// Keeps the handle in a set.
  public func store(in set: inout Set<AnyCancellable>) { set.insert(self) }

  /// Keeps the handle in a collection.
  public func store(in collection: inout some RangeReplaceableCollection<AnyCancellable>) {
    collection.append(self)
  }

  /// Whether both are the same handle.
  public static func == (lhs: AnyCancellable, rhs: AnyCancellable) -> Bool { lhs === rhs }

  /// Hashes the identity of the handle.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}
