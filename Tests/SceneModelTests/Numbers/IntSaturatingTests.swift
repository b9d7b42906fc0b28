import SceneModel
import Testing

@Suite struct IntSaturatingTests {
  @Test(
    arguments: [
      (2.5, 3), (-2.4, -2), (1e300, .max), (-1e300, .min), (.infinity, .max), (-.infinity, .min),
      (.nan, 0), (9.3e18, .max), (4e15, 4_000_000_000_000_000),
    ] as [(Double, Int)])
  func anyNumberBecomesAnInteger(_ number: Double, _ expected: Int) {
    #expect(Int(saturating: number) == expected)
  }
}
