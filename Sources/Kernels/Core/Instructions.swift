import CKernels

/// Instruction sets that a kernel may use, each including all previous ones.
package enum Instructions: String, CaseIterable, Codable, Sendable {
  /// The highest set that the processor supports.
  case automatic
  /// The baseline of the architecture.
  case portable
  /// AVX2 and FMA.
  case avx2
  /// AVX-512 F, BW, DQ and VL.
  case avx512
  /// With the byte dot products of AVX-512 VNNI.
  case avx512VNNI

  /// Whether this processor supports the set.
  package var isSupported: Bool { ck_instructions_supported(raw) }

  var raw: ck_instructions {
    switch self {
    case .automatic: ck_instructions_automatic
    case .portable: ck_instructions_portable
    case .avx2: ck_instructions_avx2
    case .avx512: ck_instructions_avx512
    case .avx512VNNI: ck_instructions_avx512_vnni
    }
  }
}
