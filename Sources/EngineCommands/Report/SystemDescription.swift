import Foundation

/// The system that the program runs on, in words.
enum SystemDescription {
  /// `Debian GNU/Linux 12 (bookworm), x86-64`.
  static var name: String {
    let system = ProcessInfo.processInfo.operatingSystemVersionString
    #if arch(x86_64)
      return "\(system), x86-64"
    #elseif arch(arm64)
      return "\(system), arm64"
    #else
      return system
    #endif
  }

  /// The model of the processor; nil if the system does not report it.
  static var processor: String? {
    let text = try? String(contentsOfFile: "/proc/cpuinfo", encoding: .utf8)
    let line = text?.split(separator: "\n").first { $0.hasPrefix("model name") }
    return line?.split(separator: ":", maxSplits: 1).last?.trimmingCharacters(in: .whitespaces)
  }
}
