import Testing

@testable import SharedCommands

@Suite struct RunProgressTests {
  @Test(arguments: [
    (0.0, "0:00"), (6.2, "0:07"), (59.5, "1:00"), (754, "12:34"), (3723, "1:02:03"),
    (-5, "0:00"), (Double.infinity, "99:59:59"),
  ])
  func durationsAreClockTimes(_ seconds: Double, _ text: String) {
    #expect(RunProgress.duration(seconds) == text)
  }

  @Test func theBarFitsIntoTheWidth() {
    let progress = RunProgress(fraction: 0.25, stage: .imageAlignment, remaining: 65)
    #expect(
      progress.bar(width: 80) == "[######..................]  25 %  aligning photos  1:05 left")
    #expect(progress.bar(width: 20).count == 19)
    #expect(RunProgress(fraction: 1).bar(width: 80) == "[########################] 100 %")
    #expect(RunProgress(fraction: 7).text == "100 %")
  }
}
