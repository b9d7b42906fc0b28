@_exported import Foundation

/// Publishes a sequence of values that ends with completion or failure.
///
/// This module has what classes that publish their state need: subjects, `Published`,
/// `ObservableObject` and the operators in Publishers.swift.
public protocol Publisher<Output, Failure> {
  /// The type of the values.
  associatedtype Output
  /// The type of the failure; `Never` if there is none.
  associatedtype Failure: Error

  /// Attaches a subscriber.
  func receive<S: Subscriber>(subscriber: S) where S.Input == Output, S.Failure == Failure
}

/// Receives values, at most as many as it requested.
public protocol Subscriber<Input, Failure> {
  /// The type of the values.
  associatedtype Input
  /// The type of the failure.
  associatedtype Failure: Error

  /// Receives the subscription through which it requests values.
  func receive(subscription: any Subscription)
  /// Receives a value; returns how many more values it requests.
  func receive(_ input: Input) -> Subscribers.Demand
  /// Receives the completion; no values follow.
  func receive(completion: Subscribers.Completion<Failure>)
}

/// An activity that can be canceled.
public protocol Cancellable {
  /// Cancels the activity.
  func cancel()
}

/// The connection between a publisher and a subscriber.
public protocol Subscription: Cancellable {
  /// Requests values.
  func request(_ demand: Subscribers.Demand)
}

/// What subscribers receive and request.
public enum Subscribers {
  /// How a sequence of values ends.
  public enum Completion<Failure: Error> {
    /// It ended normally.
    case finished
    /// It ended with an error.
    case failure(Failure)
  }

  /// The number of values requested.
  public struct Demand: Hashable, Comparable, Sendable {
    /// The number; nil means unlimited.
    public let max: Int?

    /// No limit.
    public static let unlimited = Demand(max: nil)
    /// No values.
    public static let none = Demand(max: 0)

    /// At most a given number of values.
    public static func max(_ value: Int) -> Demand { Demand(max: Swift.max(0, value)) }

    /// The sum of two demands.
    public static func + (lhs: Demand, rhs: Demand) -> Demand {
      guard let left = lhs.max, let right = rhs.max else { return .unlimited }
      let (sum, overflow) = left.addingReportingOverflow(right)
      return overflow ? .unlimited : .max(sum)
    }

    /// Whether the first requests fewer values.
    public static func < (lhs: Demand, rhs: Demand) -> Bool {
      guard let left = lhs.max else { return false }
      return rhs.max.map { left < $0 } ?? true
    }
  }
}

extension Subscribers.Completion: Sendable {}
extension Subscribers.Completion: Equatable where Failure: Equatable {}

/// Cancels a subscription when it is released.
public final class AnyCancellable: Cancellable, Hashable, @unchecked Sendable {
  private let lock = NSLock()
  private var action: (() -> Void)?

  /// Creates a handle that runs a closure when it is canceled.
  public init(_ cancel: @escaping () -> Void) { action = cancel }

  /// Creates a handle for a cancellable activity.
  public convenience init(_ canceller: some Cancellable) { self.init { canceller.cancel() } }

  deinit { action?() }

  /// Cancels the activity; later calls have no effect.
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
