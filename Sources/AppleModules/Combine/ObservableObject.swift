import Foundation

/// An object that publishes before any of its `@Published` properties changes.
public protocol ObservableObject: AnyObject {
  /// The type of the publisher.
  associatedtype ObjectWillChangePublisher: Publisher = ObservableObjectPublisher
  where ObjectWillChangePublisher.Failure == Never

  /// Publishes before the object changes.
  var objectWillChange: ObjectWillChangePublisher { get }
}

extension ObservableObject where ObjectWillChangePublisher == ObservableObjectPublisher {
  /// Publishes before the object changes.
  public var objectWillChange: ObservableObjectPublisher { ObservableObjectPublisher.of(self) }
}

extension ObservableObject {
  /// Announces a change if the object's publisher is an `ObservableObjectPublisher`.
  func announceChange() { (objectWillChange as? ObservableObjectPublisher)?.send() }
}

/// Publishes that an object is about to change.
public final class ObservableObjectPublisher: Publisher, @unchecked Sendable {
  /// The event carries no value.
  public typealias Output = Void
  /// The publisher never fails.
  public typealias Failure = Never

  private let subject = PassthroughSubject<Void, Never>()

  /// Creates a publisher.
  public init() {}

  /// Attaches a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Void, S.Failure == Never {
    subject.receive(subscriber: subscriber)
  }

  /// Publishes that the object is about to change.
  public func send() { subject.send() }

  /// The publisher of an object; it lives as long as the object.
  static func of(_ object: AnyObject) -> ObservableObjectPublisher {
    let id = ObjectIdentifier(object)
    return lock.withLock {
      if let entry = publishers[id], entry.owner === object { return entry.publisher }
      publishers = publishers.filter { $0.value.owner != nil }
      let entry = Entry(owner: object)
      publishers[id] = entry
      return entry.publisher
    }
  }

  private struct Entry {
    weak var owner: AnyObject?
    let publisher = ObservableObjectPublisher()
  }

  private static let lock = NSLock()
  nonisolated(unsafe) private static var publishers: [ObjectIdentifier: Entry] = [:]
}
