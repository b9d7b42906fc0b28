import Foundation
import SceneModel
import SharedCommands

/// All checks: what `doctor` prints.
struct DoctorReport: Codable, Equatable {
  var version = ProgramVersion.current
  /// Whether a run can be expected to work: no check has found a problem.
  var isReady: Bool
  var checks: [Check]

  init(_ checks: [Check]) {
    self.checks = checks
    isReady = checks.allSatisfy { $0.status != .problem }
  }

  /// The report as JSON.
  func encoded() throws -> String {
    String(decoding: try JSONEncoder.readable.encode(self), as: UTF8.self)
  }

  /// A line per check, with the remedy in the next one, and a summary.
  var lines: [String] {
    let width = checks.map(\.name.title.count).max() ?? 0
    return checks.flatMap { Self.lines($0, titleWidth: width) } + [summary]
  }

  private static func lines(_ check: Check, titleWidth: Int) -> [String] {
    func padded(_ text: String, _ width: Int) -> String {
      text.padding(toLength: width, withPad: " ", startingAt: 0)
    }
    let start = "\(padded(check.status.rawValue, 7))  \(padded(check.name.title, titleWidth))  "
    let indent = String(repeating: " ", count: start.count)
    return [start + check.text] + (check.remedy.map { [indent + $0] } ?? [])
  }

  private var summary: String {
    let problems = checks.count { $0.status == .problem }
    return isReady
      ? "Ready. Try 'photogrammetry-cli demo', or 'photogrammetry-cli <photos> <model>.usdz'."
      : "\(problems) problem\(problems == 1 ? "" : "s"): a run can't be expected to work."
  }
}
