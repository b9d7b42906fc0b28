import Foundation
import SharedCommands

/// The summary of an earlier batch that a new one is compared with.
struct BatchBaseline {
  struct Tolerances {
    /// Factor by which the reprojection error may grow. Chosen: sets of a few photos vary by some
    /// percent when a default changes.
    var reprojection = 1.1
    /// Absolute changes of shares. Chosen: what is seen in a preview.
    var missingShare = 0.02
    var outlineShare = 0.01
    /// Share of the triangles that a model must keep, unless it reaches the limit of its level.
    /// Chosen: a part of the object is gone.
    var triangles = 0.8
  }

  /// A dataset that got worse, and how.
  struct Regression: Equatable {
    var name: String
    var reasons: [String]

    var sentence: String { "\(name) got worse: \(reasons.joined(separator: "; "))." }
  }

  private let entries: [BatchEntry]
  var tolerances = Tolerances()

  init(_ summary: BatchSummary) { entries = summary.datasets }

  /// Reads a `batch.json`. Throws a `CommandFailure`.
  init(_ path: String) throws {
    guard let data = FileManager.default.contents(atPath: path) else {
      throw CommandFailure.usage("\(path) can't be read. Name the batch.json of an earlier batch.")
    }
    guard let summary = try? JSONDecoder().decode(BatchSummary.self, from: data) else {
      throw CommandFailure.usage(
        "\(path) is not the summary of a batch. Name the batch.json of an earlier batch.")
    }
    self.init(summary)
  }

  /// The datasets of the baseline that got worse in `summary`, in the order of the baseline.
  func regressions(in summary: BatchSummary) -> [Regression] {
    let current = Dictionary(summary.datasets.map { ($0.name, $0) }) { first, _ in first }
    return entries.compactMap { before in
      let reasons = reasons(before, current[before.name])
      return reasons.isEmpty ? nil : Regression(name: before.name, reasons: reasons)
    }
  }

  private func reasons(_ before: BatchEntry, _ after: BatchEntry?) -> [String] {
    guard [.done, .skipped].contains(before.status) else { return [] }
    guard let after else { return ["it is not in this batch"] }
    guard [.done, .skipped].contains(after.status) else {
      return ["there is no model any more (\(after.error ?? "unknown error"))"]
    }
    var reasons: [String] = []
    if let a = before.registered, let b = after.registered, b < a {
      reasons.append("\(b) photos have a pose, \(a) before")
    }
    if let a = before.triangles, let b = after.triangles,
      Double(b) < tolerances.triangles * Double(a)
    {
      reasons.append("\(b) triangles, \(a) before")
    }
    return reasons + losses(before.quality ?? RunQuality(), after.quality ?? RunQuality())
  }

  private func losses(_ before: RunQuality, _ after: RunQuality) -> [String] {
    var reasons: [String] = []
    let levels = ["good", "fair", "poor", "failed"]
    if let a = before.verdict, let b = after.verdict, let old = levels.firstIndex(of: a),
      let new = levels.firstIndex(of: b), new > old
    {
      reasons.append("the verdict is \(b), \(a) before")
    }
    if let a = before.reprojection, let b = after.reprojection, b > tolerances.reprojection * a {
      reasons.append("the reprojection error is \(Self.text(b)) pixels, \(Self.text(a)) before")
    }
    if let a = before.missingShare, let b = after.missingShare, b > a + tolerances.missingShare {
      reasons.append("\(Self.percent(b)) of the surface is missing, \(Self.percent(a)) before")
    }
    if let a = before.outlineShare, let b = after.outlineShare, b < a - tolerances.outlineShare {
      reasons.append("the model fills \(Self.percent(b)) of the outline, \(Self.percent(a)) before")
    }
    return reasons
  }

  private static func text(_ value: Double) -> String { String(format: "%.3f", value) }

  private static func percent(_ share: Double) -> String { String(format: "%.1f %%", 100 * share) }
}
