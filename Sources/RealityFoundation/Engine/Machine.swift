/// The memory and the processor that the engine runs on.
package struct Machine: Hashable, Sendable {
  /// All memory that a process may have: the machine's or its container's.
  package var totalMemoryBytes: Int
  /// What of it is free or can be freed.
  package var availableMemoryBytes: Int
  /// The processor's features as the kernel names them; nil where it does not say.
  var processorFeatures: Set<String>?

  /// What a reconstruction needs at least.
  package static let neededMemoryBytes = 2 << 30
  /// What the numeric libraries were built for, on x86-64.
  static let neededFeatures = ["sse4_1", "sse4_2", "popcnt"]

  /// The machine we are on.
  package static var current: Machine {
    func read(_ path: String) -> String {
      (try? String(contentsOfFile: path, encoding: .utf8)) ?? ""
    }
    #if arch(x86_64)
      let processor = read("/proc/cpuinfo")
    #else
      let processor = ""
    #endif
    return Machine(
      memory: read("/proc/meminfo"), processor: processor,
      containerLimit: Int(read("/sys/fs/cgroup/memory.max").trimmed),
      containerUse: Int(read("/sys/fs/cgroup/memory.current").trimmed))
  }

  /// Reads the texts of `/proc/meminfo` and `/proc/cpuinfo` and the limits of a container.
  init(memory: String, processor: String, containerLimit: Int?, containerUse: Int?) {
    func bytes(_ key: String) -> Int? {
      let line = memory.split(separator: "\n").first { $0.hasPrefix(key + ":") }
      return line?.split(whereSeparator: \.isWhitespace).dropFirst().first
        .flatMap { Int($0) }.map { $0 * 1024 }
    }
    let physical = bytes("MemTotal") ?? Int(ProcessInfo.processInfo.physicalMemory)
    let limit = Swift.min(containerLimit ?? .max, physical)
    totalMemoryBytes = limit
    availableMemoryBytes = Swift.min(
      bytes("MemAvailable") ?? physical, Swift.max(0, limit - (containerUse ?? 0)))
    let flags = processor.split(separator: "\n").first { $0.hasPrefix("flags") }
    processorFeatures = flags.map { Set($0.split(whereSeparator: \.isWhitespace).map(String.init)) }
  }

  /// What stands in the way of a reconstruction, each in a sentence with the remedy.
  package var shortfalls: [String] {
    var sentences: [String] = []
    if availableMemoryBytes < Self.neededMemoryBytes {
      sentences.append(
        "Only \(availableMemoryBytes >> 20) MB of memory are available and a reconstruction needs "
          + "\(Self.neededMemoryBytes >> 20) MB; close other programs or add memory.")
    }
    if let processorFeatures {
      let missing = Self.neededFeatures.filter { !processorFeatures.contains($0) }
      if !missing.isEmpty {
        sentences.append(
          "The processor lacks \(missing.joined(separator: ", ")); "
            + "use a machine with a 64-bit processor from 2009 or later.")
      }
    }
    return sentences
  }
}

extension String {
  fileprivate var trimmed: String { trimmingCharacters(in: .whitespacesAndNewlines) }
}
