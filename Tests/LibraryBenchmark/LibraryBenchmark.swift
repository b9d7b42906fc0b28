import ArgumentParser
import Foundation

/// Runs single components on files that `scripts/benchmark-libraries` writes and prints their cost
/// as one line of JSON, for comparison with libraries on the same input.
@main
struct LibraryBenchmark: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "library-benchmark",
    subcommands: [
      MinimalSolvers.self, RobustPoses.self, Charts.self, Simplify.self, Poisson.self,
      Features.self, Codecs.self, Metadata.self, Containers.self,
    ])
}

/// Processor time of this process, all threads, in seconds.
func processorSeconds() -> Double {
  var time = timespec()
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time)
  return Double(time.tv_sec) + 1e-9 * Double(time.tv_nsec)
}

/// Wall and processor time of one call, in seconds.
struct Cost: Codable {
  var seconds = 0.0
  var cpuSeconds = 0.0

  /// Runs `body` once.
  static func measuring<Value>(_ body: () throws -> Value) rethrows -> (value: Value, cost: Cost) {
    let clock = ContinuousClock()
    let (wall, processor) = (clock.now, processorSeconds())
    let value = try body()
    let elapsed = wall.duration(to: clock.now)
    return (value, Cost(seconds: elapsed / .seconds(1), cpuSeconds: processorSeconds() - processor))
  }
}

/// Prints a value as one line of JSON.
func printJSON(_ value: some Encodable) throws {
  let encoder = JSONEncoder()
  encoder.outputFormatting = [.sortedKeys]
  print(String(decoding: try encoder.encode(value), as: UTF8.self))
}

/// Doubles in native byte order.
enum NumberFile {
  static func read(_ path: String) throws -> [Double] {
    let data = try Data(contentsOf: URL(fileURLWithPath: path))
    return data.withUnsafeBytes { bytes in
      (0..<bytes.count / 8).map { bytes.loadUnaligned(fromByteOffset: 8 * $0, as: Double.self) }
    }
  }

  static func write(_ numbers: [Double], to path: String) throws {
    try numbers.withUnsafeBytes { Data($0) }.write(to: URL(fileURLWithPath: path))
  }
}
