import DamagedInput
import Foundation
import TestSupport
import Testing

@testable import Pipeline

@Suite struct DamagedSealedFilesTests {
  @Test func anyDamageIsDetected() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("stage")
    let payload = Data((0..<500).map { UInt8(truncatingIfNeeded: $0 &* 37) })
    try SealedFile.write(payload, madeFrom: 7, to: url)
    let whole = DamagedInput([UInt8](try Data(contentsOf: url)))
    let copies = Array(whole.truncations()) + Array(whole.mutations(3000, seed: 50, header: 32))
    for copy in copies where copy != whole.bytes {
      try Data(copy).write(to: url)
      #expect(SealedFile.read(url, madeFrom: 7) == nil)
    }
    try Data(whole.bytes).write(to: url)
    #expect(SealedFile.read(url, madeFrom: 7) == payload)
  }
}
