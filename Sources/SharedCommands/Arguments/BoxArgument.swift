import ArgumentParser

/// A box by two opposite corners.
package struct BoxArgument: ExpressibleByArgument, Equatable {
  /// The axis-aligned box.
  package let box: BoundingBox

  /// Parses `x,y,z,x,y,z`; nil unless these are finite numbers and the box has a volume.
  package init?(argument: String) {
    let numbers = argument.split(separator: ",", omittingEmptySubsequences: false)
      .map { Float($0.filter { $0 != " " }) }
    guard numbers.count == 6, numbers.allSatisfy({ $0?.isFinite == true }) else { return nil }
    let (p, q) = (numbers[..<3].map { $0 ?? 0 }, numbers[3...].map { $0 ?? 0 })
    let corners = zip(p, q).map { (min($0, $1), max($0, $1)) }
    guard corners.allSatisfy({ $0.0 < $0.1 }) else { return nil }
    box = BoundingBox(
      min: SIMD3(corners[0].0, corners[1].0, corners[2].0),
      max: SIMD3(corners[0].1, corners[1].1, corners[2].1))
  }
}
