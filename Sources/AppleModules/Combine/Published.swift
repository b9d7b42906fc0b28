import Foundation

/// A property of a class that tells its new values, and its object that it changes, right before it
/// does.
@propertyWrapper
public struct Published<Value> {
  let storage: Storage

  /// Creates a property with a value.
  public init(wrappedValue: Value) { storage = Storage(wrappedValue) }

  /// Creates a property with a value.
  public init(initialValue: Value) { storage = Storage(initialValue) }

  /// Only the properties of classes can be published.
  @available(*, unavailable, message: "@Published is only available on properties of classes")
  public var wrappedValue: Value {
    get { storage.value }
    set { storage.set(newValue) }
  }

  /// The publisher of the values, the one that there is first.
  public var projectedValue: Publisher {
    get { Publisher(storage: storage) }
    set { newValue.hand(over: storage) }
  }

  /// The value.
  public static subscript<Owner: AnyObject>(
    _enclosingInstance owner: Owner, wrapped wrapped: ReferenceWritableKeyPath<Owner, Value>,
    storage storage: ReferenceWritableKeyPath<Owner, Published<Value>>
  ) -> Value {
    get { owner[keyPath: storage].storage.value }
    set {
      let property = owner[keyPath: storage].storage
      (owner as? any ObservableObject)?.announceChange()
      property.set(newValue)
    }
  }

  /// The publisher of a property's values.
  public struct Publisher: Combine.Publisher {
    /// The type of the values.
    public typealias Output = Value
    /// There is no failure.
    public typealias Failure = Never

    let storage: Storage

    /// Begins to tell a subscriber, with the value that there is.
    public func receive<S: Subscriber>(subscriber: S) where S.Input == Value, S.Failure == Never {
      storage.subject.receive(subscriber: subscriber)
    }

    func follow(_ publisher: some Combine.Publisher<Value, Never>) {
      let storage = storage
      storage.source = publisher.sink { [weak storage] in storage?.set($0) }
    }

    /// Takes the place of another property's publisher.
    func hand(over other: Storage) { if storage !== other { other.set(storage.value) } }
  }

  /// Where the value is.
  final class Storage: @unchecked Sendable {
    private let lock = NSLock()
    private var current: Value
    let subject: CurrentValueSubject<Value, Never>
    var source: AnyCancellable?

    init(_ value: Value) {
      current = value
      subject = CurrentValueSubject(value)
    }

    var value: Value { lock.withLock { current } }

    func set(_ value: Value) {
      subject.send(value)
      lock.withLock { current = value }
    }
  }
}
