import CKernels
import Kernels
import Testing

/// The parallel loop of the C++ kernels on a system that creates only some of the requested
/// threads.
@Suite struct ParallelForTests {
  private func visits(
    count: Int, threads: Int, available: Int, failing: Int = .max
  ) throws -> (visits: [Int32], created: Int) {
    var visits = [Int32](repeating: 0, count: count)
    var created = 0
    try withKernel(KernelControl(threadCount: threads)) { control in
      ck_test_parallel_for(count, available, failing, control, &visits, &created)
    }
    return (visits, created)
  }

  @Test(arguments: [0, 1, 3, 7, 100]) func missingThreadsChangeNothing(available: Int) throws {
    let result = try visits(count: 1000, threads: 8, available: available)
    #expect(result.visits == [Int32](repeating: 1, count: 1000))
    #expect(result.created == min(available, 7))
  }

  @Test(arguments: [0, 3]) func anErrorInTheBodyIsThrown(available: Int) throws {
    #expect(throws: KernelError.failed("the body failed")) {
      _ = try visits(count: 1000, threads: 8, available: available, failing: 500)
    }
  }

  @Test func cancelingEndsTheLoop() throws {
    let flag = CancellationFlag()
    flag.cancel()
    var visits = [Int32](repeating: 0, count: 100)
    var created = 0
    #expect(throws: CancellationError.self) {
      try withKernel(KernelControl(threadCount: 4, flag: flag)) { control in
        ck_test_parallel_for(100, 1, .max, control, &visits, &created)
      }
    }
    #expect(visits.allSatisfy { $0 == 0 })
  }
}
