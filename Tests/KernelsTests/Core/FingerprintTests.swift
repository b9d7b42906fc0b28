import Kernels
import Testing

@Suite struct FingerprintTests {
  private func hash(_ text: String, seed: UInt64 = 0) -> UInt64 {
    Array(text.utf8).withUnsafeBytes { XXHash64.hash($0, seed: seed) }
  }

  /// The values of the reference program `xxhsum -H64`.
  @Test func hashesMatchTheReference() {
    #expect(hash("") == 0xEF46_DB37_51D8_E999)
    #expect(hash("a") == 0xD24E_C4F1_A98C_6E5B)
    #expect(hash("abc") == 0x44BC_2CF5_AD77_0999)
    // All lanes and all remainder lengths.
    let bytes = (0..<77).map { UInt8(truncatingIfNeeded: $0 * 3) }
    #expect(bytes.withUnsafeBytes { XXHash64.hash($0) } == 0xF341_BD52_CE7A_62E3)
  }

  @Test func everyBitChangesTheHash() {
    let bytes = (0..<77).map { UInt8($0 * 3) }
    var seen: Set<UInt64> = [bytes.withUnsafeBytes { XXHash64.hash($0) }]
    for bit in 0..<8 * bytes.count {
      var changed = bytes
      changed[bit / 8] ^= 1 << (bit % 8)
      seen.insert(changed.withUnsafeBytes { XXHash64.hash($0) })
    }
    #expect(seen.count == 8 * bytes.count + 1)
    #expect(hash("abc", seed: 1) != hash("abc"))
  }

  @Test func sequenceBoundariesChangeTheFingerprint() {
    var (a, b) = (Fingerprint(), Fingerprint())
    a.add([1, 2] as [UInt8])
    a.add([3] as [UInt8])
    b.add([1] as [UInt8])
    b.add([2, 3] as [UInt8])
    #expect(a.value != b.value)
  }
}
