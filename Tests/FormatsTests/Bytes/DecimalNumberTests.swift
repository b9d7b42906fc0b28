import Foundation
import SceneModel
import Testing

@testable import Formats

@Suite struct DecimalNumberTests {
  private func parse(_ text: String) -> (value: Double?, length: Int) {
    var offset = 0
    let value = DecimalNumber.parse(Array(text.utf8), at: &offset)
    return (value, offset)
  }

  @Test func numbersAreThoseOfTheStandardLibrary() {
    var random = SplitMix64(seed: 4)
    var texts = [
      "0", "-0", "1.", ".5", "-.5e3", "1e-7", "1E+20", "123456789012345678901234567890", "5e-324",
      "0.000000000000000000000000000001", "3.4028235e+38", "nan", "-inf", "1e999", "+7",
    ]
    for _ in 0..<3000 {
      let float = Float(bitPattern: UInt32(random.below(1 << 32)))
      if float.isFinite { texts.append("\(float)") }
      texts.append("\(Double(random.below(1 << 50)) / 1e9)")
    }
    for text in texts {
      let (value, length) = parse(text)
      let expected = Double(text)
      #expect(value == expected || value?.isNaN == expected?.isNaN, "\(text)")
      #expect(value?.sign == expected?.sign && length == text.utf8.count, "\(text)")
    }
  }

  @Test func otherWordsAreNoNumbers() {
    for text in [
      "", "-", ".", "+.", "x", "1x", "0x10", "--1", "1e", String(repeating: "e", count: 99),
    ] {
      let (value, length) = parse(text)
      #expect(value == nil && length == 0, "\(text)")
    }
    #expect(parse("12/3").length == 2 && parse("1,2").value == 1)
  }
}
