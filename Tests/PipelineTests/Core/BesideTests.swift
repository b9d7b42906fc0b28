import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct BesideTests {
  private struct Failure: Error, Equatable {
    var name: String
  }

  @Test(arguments: [1, 2])
  func bothAreDoneWhenItReturns(threads: Int) throws {
    let isDone = Locked(false)
    let value = try beside({ isDone.withLock { $0 = true } }, KernelControl(threadCount: threads)) {
      7
    }
    #expect(value == 7 && isDone.withLock { $0 })
  }

  @Test(arguments: [1, 2])
  func errorsOfBothAreThrown(threads: Int) {
    let control = KernelControl(threadCount: threads)
    #expect(throws: Failure(name: "other")) {
      try beside({ throw Failure(name: "other") }, control) {}
    }
    #expect(throws: Failure(name: "work")) {
      try beside({}, control) { throw Failure(name: "work") }
    }
  }
}
