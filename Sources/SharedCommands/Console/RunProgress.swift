import Foundation

/// The progress of a run.
package struct RunProgress: Equatable, Sendable {
  /// Share of the run that is done, 0…1.
  package var fraction = 0.0
  /// The current stage; nil before the first one.
  package var stage: RunStage?
  /// Estimated time left, in seconds.
  package var remaining: Double?

  /// Creates a progress from the share of the run that is done, 0…1, and the remaining seconds.
  package init(fraction: Double = 0, stage: RunStage? = nil, remaining: Double? = nil) {
    (self.fraction, self.stage, self.remaining) = (fraction, stage, remaining)
  }

  /// `[#####...............]  25 %  aligning photos  1:05 left`, in at most `width - 1` columns.
  package func bar(width: Int) -> String {
    let cells = 24
    let filled = min(cells, max(0, Int((fraction * Double(cells)).rounded(.down))))
    let bar =
      "[" + String(repeating: "#", count: filled)
      + String(repeating: ".", count: cells - filled) + "]"
    return String("\(bar) \(text)".prefix(max(0, width - 1)))
  }

  /// ` 25 %  aligning photos  1:05 left`.
  var text: String {
    let percent = "\(Int((min(1, max(0, fraction)) * 100).rounded(.down)))"
    var text = String(repeating: " ", count: 3 - percent.count) + "\(percent) %"
    if let stage { text += "  \(stage.title)" }
    if let remaining { text += "  \(Self.duration(remaining)) left" }
    return text
  }

  /// `0:07`, `12:34` or `1:02:03`; at most `99:59:59`.
  package static func duration(_ seconds: Double) -> String {
    let total = Int(min(max(0, seconds), 359_999).rounded(.up))
    func twoDigits(_ value: Int) -> String { value < 10 ? "0\(value)" : "\(value)" }
    let (hours, minutes) = (total / 3600, total / 60 % 60)
    return hours > 0
      ? "\(hours):\(twoDigits(minutes)):\(twoDigits(total % 60))"
      : "\(minutes):\(twoDigits(total % 60))"
  }
}
