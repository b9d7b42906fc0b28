import Combine
import Testing

@Suite struct PublishedTests {
  private final class Model: ObservableObject {
    @Published var count = 0
    @Published var name = "a"
    var unpublished = 0
  }

  private final class Plain {
    @Published var count = 0
    var target = 0
  }

  @Test func publisherBeginsWithTheValue() {
    let model = Model()
    var values: [Int] = []
    let handle = model.$count.sink { values.append($0) }
    model.count = 1
    model.count = 1
    model.count += 1
    #expect(values == [0, 1, 1, 2])
    handle.cancel()
    model.count = 9
    #expect(values == [0, 1, 1, 2] && model.count == 9)
  }

  @Test func valuesArriveBeforeThePropertyChanges() {
    let model = Model()
    var pairs: [[Int]] = []
    let handle = model.$count.dropFirst().sink { pairs.append([$0, model.count]) }
    model.count = 1
    model.count = 2
    #expect(pairs == [[1, 0], [2, 1]])
    handle.cancel()
  }

  @Test func objectAnnouncesEachChangeBeforeItHappens() {
    let model = Model()
    var seen: [String] = []
    let handle = model.objectWillChange.sink { seen.append("\(model.count)\(model.name)") }
    model.count = 1
    model.name = "b"
    model.unpublished = 1
    model.count = 1
    #expect(seen == ["0a", "1a", "1b"])
    handle.cancel()
  }

  @Test func objectsHavePublishersOfTheirOwn() {
    let (first, second) = (Model(), Model())
    #expect(first.objectWillChange === first.objectWillChange)
    #expect(first.objectWillChange !== second.objectWillChange)
  }

  @Test func propertiesOfPlainClassesPublishToo() {
    let plain = Plain()
    var values: [Int] = []
    let handle = plain.$count.sink { values.append($0) }
    plain.count = 4
    #expect(values == [0, 4])
    handle.cancel()
  }

  @Test func assignSetsAPropertyUntilCanceled() {
    let (subject, plain) = (PassthroughSubject<Int, Never>(), Plain())
    let handle = subject.assign(to: \.target, on: plain)
    subject.send(1)
    #expect(plain.target == 1)
    handle.cancel()
    subject.send(2)
    #expect(plain.target == 1)
  }

  @Test func assignToPublishedRepublishesAndAnnounces() {
    let (subject, model) = (PassthroughSubject<Int, Never>(), Model())
    var (values, changes) = ([Int](), 0)
    let handles = [
      model.$count.sink { values.append($0) }, model.objectWillChange.sink { changes += 1 },
    ]
    subject.assign(to: &model.$count)
    subject.send(1)
    subject.send(2)
    #expect(model.count == 2 && values == [0, 1, 2] && changes == 2)
    withExtendedLifetime(handles) {}
  }

  @Test func severalPublishersCanBeAssigned() {
    let (first, second) = (PassthroughSubject<Int, Never>(), PassthroughSubject<Int, Never>())
    let model = Model()
    first.assign(to: &model.$count)
    second.assign(to: &model.$count)
    second.send(2)
    #expect(model.count == 2)
    first.send(1)
    #expect(model.count == 1)
  }

  @Test func assignmentDoesNotKeepTheObjectAlive() {
    let subject = PassthroughSubject<Int, Never>()
    weak var released: Model?
    do {
      let model = Model()
      subject.assign(to: &model.$count)
      subject.send(1)
      released = model
      #expect(released?.count == 1)
    }
    #expect(released == nil)
    subject.send(2)
  }
}
