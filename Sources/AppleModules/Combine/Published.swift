import Foundation

/// Publishes a property of a class. Right before the property changes it sends the new value, and
/// the enclosing `ObservableObject` announces the change.
@propertyWrapper
public struct Published<Value> {
  let storage: Storage

  /// Creates a property with an initial value.
  public init(wrappedValue: Value) { storage = Storage(wrappedValue) }

  /// Creates a property with an initial value.
  public init(initialValue: Value) { storage = Storage(initialValue) }

  /// Unavailable: only properties of classes can be published.
  @available(*, unavailable, message: "@Published is only available on properties of classes")
  public var wrappedValue: Value {
    get { storage.value }
    set { storage.set(newValue) }
  }

  /// The publisher of the values, starting with the current one.
  public var projectedValue: Publisher {
    get { Publisher(storage: storage) }
    set { newValue.copyValue(to: storage) }
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

  /// The publisher of the values, which announces changes by `assign(to:)` as those of the object.
  public static subscript<Owner: AnyObject>(
    _enclosingInstance owner: Owner,
    projected projected: ReferenceWritableKeyPath<Owner, Publisher>,
    storage storage: ReferenceWritableKeyPath<Owner, Published<Value>>
  ) -> Publisher {
    get {
      let property = owner[keyPath: storage].storage
      property.belongs(to: owner as? any ObservableObject)
      return Publisher(storage: property)
    }
    set { newValue.copyValue(to: owner[keyPath: storage].storage) }
  }

  /// The publisher of a property's values.
  public struct Publisher: Combine.Publisher {
    /// The type of the values.
    public typealias Output = Value
    /// The publisher never fails.
    public typealias Failure = Never

    let storage: Storage

    /// Attaches a subscriber; it receives the current value first.
    public func receive<S: Subscriber>(subscriber: S) where S.Input == Value, S.Failure == Never {
      storage.subject.receive(subscriber: subscriber)
    }

    /// Assigns the values of a publisher to the property.
    func assignValues(_ publisher: some Combine.Publisher<Value, Never>) {
      let storage = storage
      storage.keep(publisher.sink { [weak storage] in storage?.announceAndSet($0) })
    }

    /// Assigns the value of this property to another one.
    func copyValue(to other: Storage) { if storage !== other { other.set(storage.value) } }
  }

  /// Reference storage of the value and its subject.
  final class Storage: @unchecked Sendable {
    private let lock = NSLock()
    private var current: Value
    private weak var owner: (any ObservableObject)?
    private var sources: [AnyCancellable] = []
    let subject: CurrentValueSubject<Value, Never>

    init(_ value: Value) {
      current = value
      subject = CurrentValueSubject(value)
    }

    var value: Value { lock.withLock { current } }

    func set(_ value: Value) {
      subject.send(value)
      lock.withLock { current = value }
    }

    /// Names the object whose changes those of the value are.
    func belongs(to object: (any ObservableObject)?) { lock.withLock { owner = object } }

    func announceAndSet(_ value: Value) {
      lock.withLock { owner }?.announceChange()
      set(value)
    }

    /// Keeps the subscription to a publisher whose values become the property's.
    func keep(_ source: AnyCancellable) { lock.withLock { sources.append(source) } }
  }
}

extension Publisher where Failure == Never {
  /// Republishes each value through a published property for as long as the property exists.
  public func assign(to published: inout Published<Output>.Publisher) {
    published.assignValues(self)
  }
}
