import Foundation
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ProgramIdentityTests {
  @Test func equalProgramsHaveTheSameFingerprint() throws {
    let folder = try TemporaryFolder()
    func fingerprint(_ content: String) throws -> UInt64 {
      ProgramIdentity.fingerprint(ofExecutable: try folder.write(content, as: "program").path)
    }
    #expect(try fingerprint("one version") == fingerprint("one version"))
    #expect(try fingerprint("one version") != fingerprint("another version"))
    #expect(ProgramIdentity.fingerprint == ProgramIdentity.fingerprint)
  }

  @Test func anUnreadableProgramEqualsNoOther() throws {
    let path = try TemporaryFolder().url.appendingPathComponent("absent").path
    let fingerprints = (0..<3).map { _ in ProgramIdentity.fingerprint(ofExecutable: path) }
    #expect(Set(fingerprints).count == 3 && !fingerprints.contains(0))
  }
}
