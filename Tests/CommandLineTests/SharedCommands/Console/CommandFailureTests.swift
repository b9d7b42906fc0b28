import Foundation
import Testing

@testable import SharedCommands

@Suite struct CommandFailureTests {
  private struct Fault: LocalizedError {
    var errorDescription: String?
    var recoverySuggestion: String?
  }

  @Test func descriptionAndRemedyAreJoined() {
    let fault = Fault(errorDescription: "It broke.", recoverySuggestion: "Mend it.")
    #expect(CommandFailure(fault).sentence == "It broke. Mend it.")
    let whole = Fault(errorDescription: "It broke. Mend it.", recoverySuggestion: "Mend it.")
    #expect(CommandFailure(whole).sentence == "It broke. Mend it.")
    #expect(CommandFailure(Fault(errorDescription: "It broke.")).sentence == "It broke.")
    #expect(
      CommandFailure(fault, isTransient: true)
        == CommandFailure(sentence: "It broke. Mend it.", exitCode: 1, isTransient: true))
  }

  @Test func failuresStayUnchanged() {
    let failure = CommandFailure.usage("No.")
    #expect(CommandFailure(failure, isTransient: true) == failure)
  }

  @Test func everyKindOfFailureHasItsExitCode() {
    #expect(CommandFailure.run("").exitCode == 1)
    #expect(CommandFailure.usage("").exitCode == 2)
    #expect(CommandFailure.interrupted("").exitCode == 130)
    #expect(CommandFailure.interrupted("").isInterrupt && !CommandFailure.run("").isInterrupt)
  }
}
