import Foundation

/// The resources that the process has used so far.
package struct ResourceUsage {
  /// The time of a monotonic clock.
  package var seconds: Double
  /// User and system time of all threads.
  package var cpuSeconds: Double
  /// The peak resident memory so far.
  package var peakMemoryBytes: Int

  /// The usage up to this moment.
  package static var now: ResourceUsage {
    var usage = rusage()
    getrusage(Int32(RUSAGE_SELF.rawValue), &usage)
    func seconds(_ time: timeval) -> Double { Double(time.tv_sec) + Double(time.tv_usec) * 1e-6 }
    return ResourceUsage(
      seconds: ProcessInfo.processInfo.systemUptime,
      cpuSeconds: seconds(usage.ru_utime) + seconds(usage.ru_stime),
      peakMemoryBytes: usage.ru_maxrss * 1024)
  }
}

extension ResourceUsage {
  /// The resident memory of the process at this moment; nil if the system does not report it.
  static var residentBytes: Int? {
    guard let text = try? String(contentsOfFile: "/proc/self/statm", encoding: .utf8) else {
      return nil
    }
    let fields = text.split(separator: " ")
    return fields.count > 1 ? Int(fields[1]).map { $0 * Int(sysconf(Int32(_SC_PAGESIZE))) } : nil
  }
}
