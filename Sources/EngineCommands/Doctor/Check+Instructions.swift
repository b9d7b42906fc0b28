import Kernels
import Pipeline

extension Check {
  /// The instruction sets that the kernels choose from, of which `supported` are available.
  static func instructions(_ supported: Set<Instructions>, of machine: Machine) -> Check {
    if let shortfall = machine.processorShortfall {
      return Check(
        .instructions, .problem, "The processor lacks instructions that the libraries need.",
        remedy: shortfall)
    }
    if supported.contains(.avx512VNNI) { return best("AVX-512 with VNNI") }
    if supported.contains(.avx512) { return best("AVX-512") }
    if supported.contains(.avx2) { return best("AVX2") }
    // Features are read on x86-64 only.
    guard machine.processorFeatures != nil else {
      return Check(
        .instructions, .note,
        "Portable code is used: only x86-64 has faster variants of the kernels.")
    }
    return Check(
      .instructions, .note,
      "The processor lacks AVX2 and FMA: a run takes about six times as long as with them.",
      remedy: "Use an x86-64 processor from 2013 or later. In a virtual machine, pass the host's "
        + "processor through (QEMU: -cpu host).")
  }

  private static func best(_ name: String) -> Check {
    Check(.instructions, .ok, "\(name) is used.")
  }
}

extension Instructions {
  /// Those that this processor supports.
  static var supported: Set<Instructions> { Set(allCases.filter(\.isSupported)) }
}
