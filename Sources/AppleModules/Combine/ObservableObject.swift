import Foundation

/// An object that tells before it changes: when one of its `Published` properties does.
public protocol ObservableObject: AnyObject {
  /// The type of the publisher.
  associatedtype ObjectWillChangePublisher: Publisher = ObservableObjectPublisher
  where ObjectWillChangePublisher.Failure == Never

  /// Tells that the object is about to change.
  var objectWillChange: ObjectWillChangePublisher { get }
}

extension ObservableObject where ObjectWillChangePublisher == ObservableObjectPublisher {
  /// Tells that the object is about to change.
  public var objectWillChange: ObservableObjectPublisher { ObservableObjectPublisher.of(self) }
}

extension ObservableObject {
  /// Tells the change where the object's publisher is of the usual kind.
  func announceChange() { (objectWillChange as? ObservableObjectPublisher)?.send() }
}

/// Tells that an object is about to change.
public final class ObservableObjectPublisher: Publisher, @unchecked Sendable {
  /// Nothing but the fact is told.
  public typealias Output = Void
  /// There is no failure.
  public typealias Failure = Never

  private let subject = PassthroughSubject<Void, Never>()

  /// Creates a publisher.
  public init() {}

  /// Begins to tell a subscriber.
  public func receive<S: Subscriber>(subscriber: S) where S.Input == Void, S.Failure == Never {
    subject.receive(subscriber: subscriber)
  }

  /// Tells that the object is about to change.
  public func send() { subject.send() }

  /// The publisher of an object, which is there for as long as the object.
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
