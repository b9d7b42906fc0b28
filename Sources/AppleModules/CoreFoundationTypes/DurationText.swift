import Foundation

/// A duration in seconds as a `DateComponentsFormatter` writes it.
struct DurationText {
  private typealias Part = (unit: DurationUnit, count: Double)

  private let formatter: DateComponentsFormatter
  private let parts: [Part]
  private let isNegative: Bool

  init(
    _ formatter: DateComponentsFormatter, seconds: Double, defaultUnits others: [DurationUnit]
  ) {
    self.formatter = formatter
    isNegative = seconds < 0
    let chosen = formatter.allowedUnits
    let units = chosen.isEmpty ? others : DurationUnit.all.filter { chosen.contains($0.unit) }
    var parts = Self.split(
      abs(seconds), into: units, keepsFraction: formatter.allowsFractionalUnits)
    if formatter.collapsesLargestUnit, let first = parts.firstIndex(where: { $0.count > 0 }),
      first + 1 < parts.count, parts[first].count == 1
    {
      parts[first + 1].count +=
        (parts[first].unit.seconds / parts[first + 1].unit.seconds).rounded()
      parts.removeFirst(first + 1)
    }
    self.parts = Self.limited(parts, to: formatter.maximumUnitCount, abs(seconds), formatter)
  }

  private static func split(
    _ seconds: Double, into units: [DurationUnit], keepsFraction: Bool
  ) -> [Part] {
    var rest = keepsFraction ? seconds : seconds.rounded(.down)
    return units.enumerated().map { index, unit in
      let isLast = index == units.count - 1
      let exact = rest / unit.seconds
      let count = isLast && keepsFraction ? exact : exact.rounded(.down)
      rest -= count * unit.seconds
      return (unit, count)
    }
  }

  /// Limits the number of units; the duration is rounded to the last unit that remains.
  private static func limited(
    _ parts: [Part], to limit: Int, _ seconds: Double, _ formatter: DateComponentsFormatter
  ) -> [Part] {
    guard limit > 0, let first = parts.firstIndex(where: { $0.count > 0 }),
      parts.count - first > limit
    else { return parts }
    let last = parts[first + limit - 1].unit.seconds
    let keepsFraction = formatter.allowsFractionalUnits
    let rounded = keepsFraction ? seconds : (seconds / last).rounded() * last
    // Rounding may carry into the next unit: 59 minutes and 50 seconds become an hour.
    let all = split(rounded, into: parts.map(\.unit), keepsFraction: keepsFraction)
    let start = all.firstIndex { $0.count > 0 } ?? first
    let units = all[start..<min(all.count, start + limit)].map(\.unit)
    return split(rounded, into: units, keepsFraction: keepsFraction)
  }

  var text: String? {
    guard !parts.isEmpty else { return nil }
    let shown = shown
    let isPositional = formatter.unitsStyle == .positional
    var text: String
    if isPositional {
      text = shown.enumerated().map { index, part in
        let digits = DurationUnit.digits(part.count)
        let isPadded = index > 0 || formatter.zeroFormattingBehavior.contains(.pad)
        return isPadded && digits.count < 2 ? "0" + digits : digits
      }.joined(separator: ":")
    } else {
      let isNarrow = formatter.unitsStyle == .abbreviated || formatter.unitsStyle == .brief
      text = shown.map { $0.unit.text($0.count, formatter.unitsStyle) }
        .joined(separator: isNarrow ? " " : ", ")
    }
    if isNegative { text = "-" + text }
    if formatter.includesApproximationPhrase { text = "About \(text)" }
    return formatter.includesTimeRemainingPhrase ? "\(text) remaining" : text
  }

  private var shown: [Part] {
    let behavior = formatter.zeroFormattingBehavior
    if behavior.contains(.pad) { return parts }
    let isPositional = formatter.unitsStyle == .positional
    let isDefault = behavior.contains(.default)
    let (lead, middle, trail) = (
      isDefault || behavior.contains(.dropLeading),
      isDefault && !isPositional || behavior.contains(.dropMiddle),
      isDefault && !isPositional || behavior.contains(.dropTrailing)
    )
    // A duration of zero is written as zero of the smallest unit.
    guard let first = parts.firstIndex(where: { $0.count > 0 }),
      let last = parts.lastIndex(where: { $0.count > 0 })
    else { return lead || trail ? parts.suffix(1) : parts }
    return parts.indices.filter { index in
      if parts[index].count > 0 { return true }
      if index < first { return !lead }
      return index > last ? !trail : !middle
    }.map { parts[$0] }
  }
}
