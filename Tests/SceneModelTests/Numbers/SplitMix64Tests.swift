import SceneModel
import Testing

@Suite struct SplitMix64Tests {
  /// The first numbers of the reference implementation (Vigna, splitmix64.c).
  @Test func numbersAreThoseOfTheReference() {
    var random = SplitMix64(seed: 1_234_567)
    let numbers = (0..<5).map { _ in random.next() }
    #expect(
      numbers == [
        6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423,
        4_593_380_528_125_082_431, 16_408_922_859_458_223_821,
      ])
  }

  @Test func seedsDetermineTheSequence() {
    var (a, b, c) = (SplitMix64(seed: 1), SplitMix64(seed: 1), SplitMix64(seed: 2))
    let (x, y, z) = (a.next(), b.next(), c.next())
    #expect(x == y && x != z)
  }

  @Test func uniformNumbersFillTheUnitInterval() {
    var random = SplitMix64(seed: 5)
    let numbers = (0..<20000).map { _ in random.uniform() }
    #expect(numbers.allSatisfy { $0 >= 0 && $0 < 1 })
    // Three standard errors of mean and variance.
    let mean = numbers.reduce(0, +) / 20000
    #expect(abs(mean - 0.5) < 3 * (1.0 / 12 / 20000).squareRoot())
    let variance = numbers.reduce(0) { $0 + ($1 - mean) * ($1 - mean) } / 20000
    #expect(abs(variance - 1.0 / 12) < 3 * (1.0 / 180 / 20000).squareRoot())
  }

  @Test func boundedNumbersReachEveryValueEqually() {
    var random = SplitMix64(seed: 6)
    var counts = [Int](repeating: 0, count: 7)
    for _ in 0..<14000 { counts[random.below(7)] += 1 }
    // Chi-squared with 6 degrees of freedom: 22.5 has a probability of 0.1 %.
    let deviation = counts.reduce(0.0) { $0 + Double(($1 - 2000) * ($1 - 2000)) / 2000 }
    #expect(deviation < 22.5)
  }

  @Test func distinctNumbersDontRepeat() {
    var random = SplitMix64(seed: 7)
    for count in 0...10 {
      let numbers = random.distinct(count, below: 10)
      #expect(numbers.count == count && Set(numbers).count == count)
      #expect(numbers.allSatisfy { (0..<10).contains($0) })
    }
    #expect(Set(random.distinct(20, below: 4)) == [0, 1, 2, 3])
    #expect(random.distinct(3, below: 0).isEmpty)
  }
}
