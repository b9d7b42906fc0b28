import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct DescriptorMatchingTests {
  /// Descriptors with the length and the distribution of RootSIFT.
  static func descriptors(_ count: Int, seed: UInt64) -> [UInt8] {
    var random = SeededGenerator(seed: seed)
    return (0..<count).flatMap { _ in
      let values = (0..<128).map { _ in -log(1 - random.uniform()) }
      let sum = values.reduce(0, +)
      return values.map { UInt8(min(255, (512 * ($0 / sum).squareRoot()).rounded())) }
    }
  }

  /// `count` features, the first half of which are noisy copies of `other` in reverse order.
  static func noisyCopy(of other: [UInt8], _ count: Int, seed: UInt64) -> [UInt8] {
    var random = SeededGenerator(seed: seed)
    var result = descriptors(count, seed: seed &+ 99)
    let otherCount = other.count / 128
    for index in 0..<min(count, otherCount) / 2 {
      for k in 0..<128 {
        let value = Int(other[(otherCount - 1 - index) * 128 + k]) + Int(random.next() % 21) - 10
        result[index * 128 + k] = UInt8(min(255, max(0, value)))
      }
    }
    return result
  }

  static func set(_ descriptors: [UInt8]) -> FeatureSet {
    let count = descriptors.count / 128
    return FeatureSet(
      positions: Array(repeating: .zero, count: count),
      scales: Array(repeating: 1, count: count),
      orientations: Array(repeating: 0, count: count), descriptors: descriptors,
      colors: Array(repeating: .zero, count: count))
  }

  /// The expected result by brute force.
  static func reference(_ a: [UInt8], _ b: [UInt8], ratio: Double) -> Set<FeatureMatch> {
    func distance(_ i: Int, _ j: Int) -> Int {
      (0..<128).reduce(0) {
        let d = Int(a[i * 128 + $1]) - Int(b[j * 128 + $1])
        return $0 + d * d
      }
    }
    let (rows, columns) = (a.count / 128, b.count / 128)
    let table = (0..<rows).map { i in (0..<columns).map { distance(i, $0) } }
    func best(_ values: [Int]) -> Int? {
      let order = values.indices.sorted { (values[$0], $0) < (values[$1], $1) }
      let second = order.count > 1 ? values[order[1]] : 1 << 20
      guard let first = order.first,
        Double(values[first]) < ratio * ratio * Double(second)
      else { return nil }
      return first
    }
    return Set(
      (0..<rows).compactMap { i in
        guard let j = best(table[i]), best((0..<rows).map { table[$0][j] }) == i else { return nil }
        return FeatureMatch(first: Int32(i), second: Int32(j))
      })
  }

  static let supported = Instructions.allCases.filter(\.isSupported)

  @Test(
    arguments: supported, [(0, 5), (1, 1), (1, 40), (40, 1), (33, 70), (200, 161)])
  func matchesBruteForce(
    instructions: Instructions, counts: (Int, Int)
  ) throws {
    let a = Self.descriptors(counts.0, seed: 3)
    let b = Self.noisyCopy(of: a, counts.1, seed: 4)
    var matching = DescriptorMatching()
    matching.ratio = 0.9
    matching.maximumDistance = .infinity
    matching.instructions = instructions
    let matches = try matching.matches(Self.set(a), Self.set(b), KernelControl())
    #expect(matches.count == Set(matches).count)
    #expect(Set(matches) == Self.reference(a, b, ratio: 0.9))
  }

  @Test(arguments: supported)
  func allInstructionSetsGiveTheSameResult(instructions: Instructions) throws {
    // More than one block of rows, and not a multiple of any vector width.
    let a = Self.descriptors(4200, seed: 1)
    let b = Self.noisyCopy(of: a, 517, seed: 2)
    var matching = DescriptorMatching()
    matching.instructions = .portable
    let expected = try matching.matches(Self.set(a), Self.set(b), KernelControl())
    matching.instructions = instructions
    #expect(expected.count > 200)
    #expect(try matching.matches(Self.set(a), Self.set(b), KernelControl()) == expected)
    #expect(
      Set(try matching.matches(Self.set(b), Self.set(a), KernelControl()))
        == Set(expected.map { FeatureMatch(first: $0.second, second: $0.first) }))
  }

  @Test(arguments: supported)
  func extremeBytesDoNotOverflow(instructions: Instructions) throws {
    var a = [UInt8](repeating: 255, count: 64 * 128)
    for index in 0..<64 { for k in 0..<index { a[index * 128 + k] = 0 } }
    var matching = DescriptorMatching()
    matching.maximumDistance = .infinity
    matching.instructions = instructions
    let matches = try matching.matches(Self.set(a), Self.set(a), KernelControl())
    #expect(matches.count == 64 && matches.allSatisfy { $0.first == $0.second })
  }

  @Test func duplicateDescriptorsAreAmbiguous() throws {
    let a = Self.descriptors(10, seed: 5)
    let twins = a + a[0..<128]
    let matches = try DescriptorMatching().matches(Self.set(a), Self.set(twins), KernelControl())
    #expect(Set(matches.map(\.first)) == Set(1..<10))
  }

  @Test func prefixLimitsBothSides() throws {
    let a = Self.descriptors(100, seed: 6)
    let matches = try DescriptorMatching().matches(
      Self.set(a), Self.set(a), prefix: 30, KernelControl())
    #expect(Set(matches.map(\.first)) == Set(0..<30))
  }
}
