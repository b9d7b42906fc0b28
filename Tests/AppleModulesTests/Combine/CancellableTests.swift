import Combine
import Testing

@Suite struct CancellableTests {
  private final class Counter: Cancellable {
    var count = 0
    func cancel() { count += 1 }
  }

  @Test func actionRunsOnce() {
    var count = 0
    let handle = AnyCancellable { count += 1 }
    #expect(count == 0)
    handle.cancel()
    handle.cancel()
    #expect(count == 1)
  }

  @Test func releaseCancels() {
    let counter = Counter()
    var handle: AnyCancellable? = AnyCancellable(counter)
    #expect(counter.count == 0 && handle != nil)
    handle = nil
    #expect(counter.count == 1)
  }

  @Test func collectionsKeepSubscriptionsAlive() {
    let subject = PassthroughSubject<Int, Never>()
    var (set, array) = (Set<AnyCancellable>(), [AnyCancellable]())
    var values: [Int] = []
    subject.sink { values.append($0) }.store(in: &set)
    subject.sink { values.append(10 * $0) }.store(in: &array)
    subject.send(1)
    #expect(Set(values) == [1, 10] && set.count == 1 && array.count == 1)
    set.removeAll()
    subject.send(2)
    #expect(values.count == 3 && values.last == 20)
  }

  @Test func equalityIsIdentity() {
    let (a, b) = (AnyCancellable {}, AnyCancellable {})
    #expect(a == a && a != b && Set([a, b, a]).count == 2)
  }

  @Test func droppedHandlesEndSubscriptions() {
    let subject = PassthroughSubject<Int, Never>()
    var values: [Int] = []
    _ = subject.sink { values.append($0) }
    subject.send(1)
    #expect(values.isEmpty)
  }
}
