import Foundation

/// The memory that a control group of the process may use: that of a container, or of a job of a
/// scheduler.
struct MemoryGroup: Equatable, Sendable {
  /// In bytes.
  var limit: Int
  /// The bytes in use by all processes of the group.
  var use: Int

  /// The group with the least memory left; nil without a limit. `groups` is the content of
  /// `/proc/self/cgroup`, `read` returns the content of a file, or an empty text.
  static func tightest(_ groups: String, read: (String) -> String) -> MemoryGroup? {
    func number(_ file: String) -> Int? {
      Int(read(file).trimmingCharacters(in: .whitespacesAndNewlines))
    }
    let second = ProcessorShare.controlGroups(groups).compactMap { folder in
      number(folder + "/memory.max").map {
        MemoryGroup(limit: $0, use: number(folder + "/memory.current") ?? 0)
      }
    }
    let first = firstVersion(groups).compactMap { folder in
      number(folder + "/memory.limit_in_bytes").map {
        MemoryGroup(limit: $0, use: number(folder + "/memory.usage_in_bytes") ?? 0)
      }
    }
    return (second + first).min { $0.limit - $0.use < $1.limit - $1.use }
  }

  /// The folders of the memory controller of version 1, from a line such as
  /// `9:memory:/slurm/job_1`.
  private static func firstVersion(_ text: String) -> [String] {
    let line = text.split(separator: "\n").first { line in
      let fields = line.split(separator: ":", omittingEmptySubsequences: false)
      return fields.count >= 3 && fields[1].split(separator: ",").contains("memory")
    }
    guard let path = line?.split(separator: ":", omittingEmptySubsequences: false).last else {
      return []
    }
    let names = path.split(separator: "/")
    return (0...names.count).map {
      (["/sys/fs/cgroup/memory"] + names.prefix($0).map(String.init)).joined(separator: "/")
    }
  }
}
