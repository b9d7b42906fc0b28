import CoreFoundationTypes
import Foundation
import Testing

@Suite struct DateComponentsFormatterTests {
  private let hourMinuteSecond: NSCalendar.Unit = [.hour, .minute, .second]

  private func text(
    _ seconds: Double, _ style: DateComponentsFormatter.UnitsStyle = .abbreviated,
    _ units: NSCalendar.Unit? = nil, configure: (DateComponentsFormatter) -> Void = { _ in }
  ) -> String? {
    let formatter = DateComponentsFormatter()
    formatter.unitsStyle = style
    formatter.allowedUnits = units ?? hourMinuteSecond
    configure(formatter)
    return formatter.string(from: seconds)
  }

  @Test(
    arguments: [
      (DateComponentsFormatter.UnitsStyle.positional, "1:10:05"), (.abbreviated, "1h 10m 5s"),
      (.short, "1 hr, 10 min, 5 sec"), (.full, "1 hour, 10 minutes, 5 seconds"),
      (.spellOut, "one hour, ten minutes, five seconds"), (.brief, "1hr 10min 5sec"),
    ] as [(DateComponentsFormatter.UnitsStyle, String)]) func stylesWriteUnits(
      style: DateComponentsFormatter.UnitsStyle, expected: String
    )
  {
    #expect(text(4205, style) == expected)
  }

  @Test(
    arguments: [
      (DateComponentsFormatter.UnitsStyle.abbreviated, "1y 1mo 1w 2d"),
      (.short, "1 yr, 1 mth, 1 wk, 2 days"), (.brief, "1yr 1mth 1wk 2days"),
      (.full, "1 year, 1 month, 1 week, 2 days"),
    ] as [(DateComponentsFormatter.UnitsStyle, String)]) func longUnitsHaveNames(
      style: DateComponentsFormatter.UnitsStyle, expected: String
    )
  {
    let seconds = 86400.0 * (365 + 30 + 7 + 2)
    #expect(text(seconds, style, [.year, .month, .weekOfMonth, .day]) == expected)
  }

  @Test func zerosAreLeftOutByDefault() {
    #expect(text(3600) == "1h" && text(3605) == "1h 5s" && text(65) == "1m 5s")
    #expect(text(0) == "0s" && text(0, .full) == "0 seconds")
  }

  @Test func positionsKeepInnerZerosByDefault() {
    #expect(text(3605, .positional) == "1:00:05" && text(3600, .positional) == "1:00:00")
    #expect(text(65, .positional) == "1:05" && text(5, .positional) == "5")
    #expect(text(0, .positional) == "0")
  }

  @Test(
    arguments: [
      (DateComponentsFormatter.ZeroFormattingBehavior.pad, "0h 0m 5s", "1h 0m 0s"),
      ([], "0h 0m 5s", "1h 0m 0s"), (.dropLeading, "5s", "1h 0m 0s"),
      (.dropTrailing, "0h 0m 5s", "1h"), (.dropAll, "5s", "1h"),
    ] as [(DateComponentsFormatter.ZeroFormattingBehavior, String, String)])
  func zeroBehaviorIsFollowed(
    behavior: DateComponentsFormatter.ZeroFormattingBehavior, five: String, hour: String
  ) {
    #expect(text(5) { $0.zeroFormattingBehavior = behavior } == five)
    #expect(text(3600) { $0.zeroFormattingBehavior = behavior } == hour)
  }

  @Test func middleZerosCanBeLeftOut() {
    #expect(text(3605) { $0.zeroFormattingBehavior = .dropMiddle } == "1h 5s")
    #expect(text(3605) { $0.zeroFormattingBehavior = .dropTrailing } == "1h 0m 5s")
  }

  @Test func paddedPositionsHaveTwoDigits() {
    #expect(text(65, .positional) { $0.zeroFormattingBehavior = .pad } == "00:01:05")
    #expect(text(36005, .positional) { $0.zeroFormattingBehavior = .pad } == "10:00:05")
    #expect(
      text(65, .positional, [.minute, .second]) { $0.zeroFormattingBehavior = .pad } == "01:05")
  }

  @Test(
    arguments: [
      (3599.0, 1, "1h"), (3569, 1, "59m"), (3570, 1, "1h"), (3599, 2, "59m 59s"), (86399, 2, "24h"),
      (4205, 2, "1h 10m"), (4235, 2, "1h 11m"), (7199, 2, "2h"), (29, 1, "29s"), (90, 1, "2m"),
      (89, 1, "1m"),
    ] as [(Double, Int, String)]) func fewerUnitsAreRoundedWithCarry(
      seconds: Double, count: Int, expected: String
    )
  {
    #expect(text(seconds) { $0.maximumUnitCount = count } == expected)
  }

  @Test func carryReachesADay() {
    let units: NSCalendar.Unit = [.day, .hour, .minute, .second]
    #expect(text(86399, .full, units) { $0.maximumUnitCount = 2 } == "1 day")
    #expect(text(86399, .full, units) == "23 hours, 59 minutes, 59 seconds")
  }

  @Test func onlyAllowedUnitsAreUsed() {
    #expect(text(7325, .abbreviated, [.minute]) == "122m")
    #expect(text(7325, .abbreviated, [.hour, .second]) == "2h 125s")
    #expect(text(59, .abbreviated, [.hour]) == "0h")
  }

  @Test func withoutChoiceAllUnitsAreAllowed() {
    #expect(text(90061, .abbreviated, []) == "1d 1h 1m 1s")
  }

  @Test func fractionsAreCutOffUnlessAllowed() {
    #expect(text(5.9) == "5s" && text(59.99) == "59s")
    #expect(text(90, .full, [.minute]) { $0.allowsFractionalUnits = true } == "1.5 minutes")
    #expect(text(120, .full, [.minute]) { $0.allowsFractionalUnits = true } == "2 minutes")
  }

  @Test func aSingleLargestUnitCollapses() {
    #expect(text(63) { $0.collapsesLargestUnit = true } == "63s")
    #expect(text(123) { $0.collapsesLargestUnit = true } == "2m 3s")
  }

  @Test func phrasesSurroundTheText() {
    let both = text(300, .full) {
      ($0.includesApproximationPhrase, $0.includesTimeRemainingPhrase) = (true, true)
    }
    #expect(both == "About 5 minutes remaining")
    #expect(text(300, .short) { $0.includesTimeRemainingPhrase = true } == "5 min remaining")
  }

  @Test func negativeTimesHaveASign() {
    #expect(text(-65) == "-1m 5s" && text(-65, .positional) == "-1:05")
  }

  @Test func meaninglessNumbersHaveNoText() {
    for seconds in [Double.nan, .infinity, -.infinity, 1e16] { #expect(text(seconds) == nil) }
  }

  @Test func componentsChooseTheirUnits() {
    let formatter = DateComponentsFormatter()
    formatter.unitsStyle = .full
    let components = DateComponents(hour: 1, minute: 90)
    #expect(formatter.string(from: components) == "2 hours, 30 minutes")
    #expect(formatter.string(for: components) == "2 hours, 30 minutes")
    #expect(formatter.string(for: "text") == nil && formatter.string(from: DateComponents()) == nil)
    #expect(
      DateComponentsFormatter.localizedString(
        from: DateComponents(minute: 1, second: 5), unitsStyle: .positional) == "1:05")
  }

  @Test func datesGiveTheTimeBetweenThem() {
    let formatter = DateComponentsFormatter()
    formatter.unitsStyle = .abbreviated
    let start = Date(timeIntervalSince1970: 1000)
    #expect(formatter.string(from: start, to: start.addingTimeInterval(75)) == "1m 15s")
  }
}
