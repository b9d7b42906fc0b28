import Foundation

/// The memory and the processor that are available to a run.
package struct Machine: Hashable, Sendable {
  /// Memory limit of the process, in bytes: the machine's memory or its container's limit.
  package var totalMemoryBytes: Int
  /// The part of it that is free or can be reclaimed.
  package var availableMemoryBytes: Int
  /// The processor's features by the kernel's names; nil if the kernel lists none.
  package var processorFeatures: Set<String>?

  /// The minimum memory of a reconstruction, in bytes. Chosen.
  package static let neededMemoryBytes = 2 << 30
  /// The instruction sets that the numeric libraries are built for, on x86-64.
  static let neededFeatures = ["sse4_1", "sse4_2", "popcnt"]

  package init(
    totalMemoryBytes: Int, availableMemoryBytes: Int? = nil, processorFeatures: Set<String>? = nil
  ) {
    self.totalMemoryBytes = totalMemoryBytes
    self.availableMemoryBytes = availableMemoryBytes ?? totalMemoryBytes
    self.processorFeatures = processorFeatures
  }

  /// This machine. Tests replace it with `$override`.
  package static var current: Machine { override ?? measured }

  /// Replaces `current` within a task or closure.
  @TaskLocal package static var override: Machine?

  private static var measured: Machine {
    func read(_ path: String) -> String {
      (try? String(contentsOfFile: path, encoding: .utf8)) ?? ""
    }
    #if arch(x86_64)
      let processor = read("/proc/cpuinfo")
    #else
      let processor = ""
    #endif
    let group = MemoryGroup.tightest(read("/proc/self/cgroup"), read: read)
    return Machine(
      memory: read("/proc/meminfo"), processor: processor, containerLimit: group?.limit,
      containerUse: group?.use)
  }

  /// Parses the texts of `/proc/meminfo` and `/proc/cpuinfo`; the container's limit and use are in
  /// bytes.
  init(memory: String, processor: String, containerLimit: Int?, containerUse: Int?) {
    func bytes(_ key: String) -> Int? {
      let line = memory.split(separator: "\n").first { $0.hasPrefix(key + ":") }
      return line?.split(whereSeparator: \.isWhitespace).dropFirst().first
        .flatMap { Int($0) }.map { $0 * 1024 }
    }
    let physical = bytes("MemTotal") ?? Int(ProcessInfo.processInfo.physicalMemory)
    let limit = Swift.min(containerLimit ?? .max, physical)
    let flags = processor.split(separator: "\n").first { $0.hasPrefix("flags") }
    self.init(
      totalMemoryBytes: limit,
      availableMemoryBytes: Swift.min(
        bytes("MemAvailable") ?? physical, Swift.max(0, limit - (containerUse ?? 0))),
      processorFeatures: flags.map {
        Set($0.split(whereSeparator: \.isWhitespace).map(String.init))
      })
  }

  /// The reasons why a reconstruction can't run on this machine, as sentences with a remedy; empty
  /// if it can.
  package var shortfalls: [String] { [memoryShortfall, processorShortfall].compactMap(\.self) }

  /// Why the memory doesn't suffice, as a sentence with a remedy.
  package var memoryShortfall: String? {
    guard availableMemoryBytes < Self.neededMemoryBytes else { return nil }
    return
      "Only \(availableMemoryBytes >> 20) MB of memory is available and a reconstruction needs "
      + "\(Self.neededMemoryBytes >> 20) MB; close other programs or add memory."
  }

  /// Why the processor can't run the numeric libraries, as a sentence with a remedy.
  package var processorShortfall: String? {
    guard let processorFeatures else { return nil }
    let missing = Self.neededFeatures.filter { !processorFeatures.contains($0) }
    guard !missing.isEmpty else { return nil }
    return "The processor lacks \(missing.joined(separator: ", ")); "
      + "use a machine with a 64-bit processor from 2009 or later."
  }
}

extension Machine {
  /// Memory in GiB from which on a run has the largest limits. Chosen.
  private static let sufficientGibibytes = 7.5
  /// Photos per GiB of memory. Chosen: 1000 photos need somewhat less than `sufficientGibibytes`,
  /// half of it for the cloud, and alignment of 10,000 photos of synthetic features took 18.7 GiB.
  private static let photosPerGibibyte = 134.0

  /// Memory of a point of the dense cloud while the surface is made from it. Measured: 260 bytes on
  /// the town of 100 photos at reduced (2.9 million points), with a reserve.
  private static let bytesPerPoint = 300

  /// Photos in proportion to the memory, 1000 with 7.5 GiB, but 100 at least. They have at most
  /// 16384 pixels per side, and 8192 with less memory than that. Decoded photos take an eighth of
  /// the memory, from 256 MiB to 1 GiB, and the surface solver at most half of it, as the dense
  /// cloud.
  package var limits: MemoryLimits {
    let gibibytes = Double(totalMemoryBytes) / Double(1 << 30)
    return MemoryLimits(
      maximumPhotos: min(
        MemoryLimits.mostPhotos, max(100, Int(gibibytes * Self.photosPerGibibyte))),
      maximumPhotoSide: gibibytes >= Self.sufficientGibibytes ? 16384 : 8192,
      imageMemory: min(1 << 30, max(256 << 20, totalMemoryBytes / 8)),
      surfaceMemory: totalMemoryBytes / 2,
      cloudPoints: totalMemoryBytes / 2 / Self.bytesPerPoint)
  }
}
