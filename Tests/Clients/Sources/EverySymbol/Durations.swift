import Foundation
import RealityKit

/// Formats durations.
func useDurations() {
  let formatter = DateComponentsFormatter()
  formatter.allowedUnits = [.hour, .minute, .second]
  check(formatter.string(from: 3725) == "1:02:05", "digits")
  check(formatter.string(from: 5) == "5", "no leading zeros")
  formatter.zeroFormattingBehavior = .pad
  check(formatter.string(from: 65) == "00:01:05", "padded")
  formatter.zeroFormattingBehavior = DateComponentsFormatter.ZeroFormattingBehavior.default
  let texts: [(DateComponentsFormatter.UnitsStyle, String)] = [
    (.abbreviated, "1h 5s"), (.short, "1 hr, 5 sec"), (.brief, "1hr 5sec"),
    (.full, "1 hour, 5 seconds"), (.spellOut, "one hour, five seconds"), (.positional, "1:00:05"),
  ]
  for (style, text) in texts {
    formatter.unitsStyle = style
    check(formatter.string(from: 3605) == text, text)
  }
  formatter.unitsStyle = .full
  formatter.zeroFormattingBehavior = [.dropLeading, .dropTrailing]
  check(formatter.string(from: 3605) == "1 hour, 0 minutes, 5 seconds", "zeros in the middle")
  formatter.zeroFormattingBehavior = .dropMiddle
  check(formatter.string(from: 5) == "0 hours, 0 minutes, 5 seconds", "leading zeros")
  formatter.zeroFormattingBehavior = .dropAll
  formatter.maximumUnitCount = 1
  formatter.includesApproximationPhrase = true
  formatter.includesTimeRemainingPhrase = true
  check(formatter.string(from: 3590) == "About 1 hour remaining", "rounded")
  let plain = DateComponentsFormatter()
  plain.collapsesLargestUnit = true
  plain.allowsFractionalUnits = true
  plain.allowedUnits = [.minute, .second]
  check(plain.string(from: 75.5) == "75.5", "one unit")
  plain.calendar = Calendar(identifier: .gregorian)
  plain.referenceDate = Date()
  let now = Date()
  check(plain.string(from: now, to: now.addingTimeInterval(240)) == "4:00", "dates")
  check(plain.string(from: DateComponents(minute: 3, second: 4)) == "3:04", "components")
  check(plain.string(for: DateComponents(second: 4)) == "4", "any")
  let text = DateComponentsFormatter.localizedString(
    from: DateComponents(hour: 2, minute: 1), unitsStyle: .full)
  check(text == "2 hours, 1 minute", "in a style")
}
