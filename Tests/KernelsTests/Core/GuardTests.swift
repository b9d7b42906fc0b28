import CKernels
import Foundation
import Testing

/// Errors inside kernels become statuses, whatever their reason.
@Suite struct GuardTests {
  @Test func longMessagesAreCutOff() {
    var visits: [Int32] = []
    var created = 0
    _ = ck_test_parallel_for(0, 0, 0, nil, &visits, &created)
  }

  #if os(Linux)
    /// The message of an exception must not need memory: it may say that there is none.
    @Test func errorsAreReportedWithoutMemory() async {
      await #expect(processExitsWith: .success) {
        let message = "A message longer than what a string can hold without allocating memory."
        let status = message.withCString { ck_test_failure_without_memory($0) }
        #expect(status == ck_failed)
        #expect(String(cString: ck_last_error()) == message)
      }
    }
  #endif
}
