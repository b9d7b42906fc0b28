import Foundation
import Testing

@testable import os

@Suite struct LogFormatTests {
  private func text(_ format: String, _ values: any CVarArg...) -> String {
    LogFormat(format).text(values)
  }

  @Test func valuesAreFormattedAsByPrintf() {
    #expect(text("%d of %ld", 3, 5) == "3 of 5" && text("%.2f m", 1.005e2) == "100.50 m")
    #expect(text("%5d|%-5d|%05d", 42, 42, 42) == "   42|42   |00042")
    #expect(text("%x %llu", 255, UInt64.max) == "ff 18446744073709551615")
    #expect(text("%@", NSString("boot")) == "boot")
    #expect(text("no values") == "no values" && text("") == "")
  }

  @Test func privacyIsInBraces() {
    #expect(text("%{public}d %{private}d", 1, 2) == "1 <private>")
    #expect(text("%{sensitive}@!", NSString("secret")) == "<private>!")
    #expect(text("%{public, location:escape_only}@", NSString("x")) == "x")
    #expect(text("%{private, mask.hash}d", 5) == "<private>")
  }

  @Test func percentSignsAreDoubled() {
    #expect(text("100%%") == "100%" && text("%d%% of %%", 50) == "50% of %")
    #expect(text("100%% %{private}d", 1) == "100% <private>")
  }

  @Test func missingValuesStayAsTheFormatHasThem() {
    #expect(text("%d and %d", 1) == "1 and %d")
    #expect(text("100%% %d") == "100% %d")
  }
}
