import CKernels

/// Sets of instructions that a kernel may use, each with all of those before it.
package enum Instructions: String, CaseIterable, Codable, Sendable {
  /// The last of these that the processor has.
  case automatic
  /// What every processor of the architecture has.
  case portable
  /// AVX2 and FMA.
  case avx2
  /// AVX-512 F, BW, DQ and VL.
  case avx512
  /// The products of bytes of AVX-512 VNNI.
  case avx512VNNI

  /// Whether this processor has them.
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
