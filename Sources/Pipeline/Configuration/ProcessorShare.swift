import Foundation

/// The processors that the process may use.
package struct ProcessorShare: Equatable, Sendable {
  /// Processors of the machine.
  package var installed: Int
  /// Processors that the process may run on: its affinity.
  package var usable: Int
  /// Processor seconds per second that the control groups of the process allow; nil without a
  /// limit.
  package var quota: Double?

  package init(installed: Int, usable: Int, quota: Double?) {
    (self.installed, self.usable, self.quota) = (installed, usable, quota)
  }

  /// The number of threads that can work at the same time, at least 1: that of a run, unless the
  /// user chooses one.
  package var threads: Int { max(1, min(usable, Int((quota ?? .infinity).rounded(.up).clamped))) }

  /// Of this process, when it was first asked for.
  package static let current: ProcessorShare = {
    func read(_ path: String) -> String? { try? String(contentsOfFile: path, encoding: .utf8) }
    let groups = controlGroups(read("/proc/self/cgroup") ?? "")
    // `activeProcessorCount` counts all processors that are switched on, whatever the affinity.
    let active = ProcessInfo.processInfo.activeProcessorCount
    return ProcessorShare(
      installed: active, usable: affinity(read("/proc/self/status") ?? "") ?? active,
      quota: groups.compactMap { read($0 + "/cpu.max").flatMap(quota(in:)) }.min())
  }()

  /// The number of processors in the line `Cpus_allowed_list`, such as `0-3,8`, of a process's
  /// `status` file; nil if it can't be parsed.
  static func affinity(_ text: String) -> Int? {
    let key = "Cpus_allowed_list:"
    guard let line = text.split(separator: "\n").first(where: { $0.hasPrefix(key) }) else {
      return nil
    }
    let counts = line.dropFirst(key.count).split(separator: ",").map { range -> Int? in
      let ends = range.split(separator: "-").map {
        UInt32($0.trimmingCharacters(in: .whitespaces)).map { Int($0) }
      }
      guard let first = ends.first ?? nil, let last = ends.last ?? nil, ends.count <= 2,
        first <= last
      else { return nil }
      return last - first + 1
    }
    return counts.isEmpty || counts.contains(nil) ? nil : counts.reduce(0) { $0 + ($1 ?? 0) }
  }

  /// The folders of a process's control group and of those around it, from the content of its
  /// `cgroup` file (control groups version 2).
  static func controlGroups(_ text: String) -> [String] {
    let root = "/sys/fs/cgroup"
    let line = text.split(separator: "\n").first { $0.hasPrefix("0::/") }
    let names = line?.dropFirst(4).split(separator: "/") ?? []
    return (0...names.count).map {
      ([root] + names.prefix($0).map(String.init)).joined(separator: "/")
    }
  }

  /// The quota in a `cpu.max` file, such as `200000 100000` for two processors; nil for `max` or
  /// what can't be parsed.
  static func quota(in text: String) -> Double? {
    let numbers = text.split(whereSeparator: \.isWhitespace).map { Double($0) }
    guard numbers.count == 2, let time = numbers[0], let period = numbers[1], time > 0, period > 0
    else { return nil }
    return time / period
  }
}

extension Double {
  /// A value that can be converted to `Int`.
  fileprivate var clamped: Double { Swift.min(self, 1e9) }
}
