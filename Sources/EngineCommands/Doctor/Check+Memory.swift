import Pipeline
import SharedCommands

extension Check {
  /// The memory, and the levels of detail and number of photos for which it suffices.
  static func memory(of machine: Machine) -> Check {
    if machine.memoryShortfall != nil {
      return Check(
        .memory, .problem,
        "\(gigabytes(machine.availableMemoryBytes)) of \(gigabytes(machine.totalMemoryBytes)) are "
          + "available; a run needs \(gigabytes(Machine.neededMemoryBytes)).",
        remedy: "Close other programs, or use a machine or container with more memory.")
    }
    let fitting = DetailArgument.allCases.filter {
      DetailChoice.level($0).expectedMemoryBytes <= machine.availableMemoryBytes
    }
    let text =
      "\(gigabytes(machine.availableMemoryBytes)) of \(gigabytes(machine.totalMemoryBytes)) are "
      + "available: enough for \(levels(upTo: fitting.last)) and for up to "
      + "\(machine.limits.maximumPhotos) photos."
    guard let next = DetailArgument.allCases.dropFirst(fitting.count).first else {
      return Check(.memory, .ok, text)
    }
    let needed = gigabytes(DetailChoice.level(next).expectedMemoryBytes)
    return Check(
      .memory, .note, text,
      remedy: "For '-d \(next.rawValue)' have \(needed) available: close other programs, or use a "
        + "machine with more memory.")
  }

  /// The levels from the lowest one to `highest`, in words.
  static func levels(upTo highest: DetailArgument?) -> String {
    guard let highest, highest != .preview else { return "-d preview" }
    return highest == DetailArgument.allCases.last
      ? "every level of detail" : "-d preview to -d \(highest.rawValue)"
  }
}
