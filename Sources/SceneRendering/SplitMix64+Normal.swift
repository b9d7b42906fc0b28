import Foundation
import SceneModel

extension SplitMix64 {
  /// A normally distributed number with mean 0 and standard deviation 1 (Box and Muller).
  package mutating func normal() -> Double {
    let radius = (-2 * log(1 - uniform())).squareRoot()
    return radius * cos(2 * .pi * uniform())
  }

  /// Three independent normally distributed numbers.
  package mutating func normal3() -> SIMD3<Double> {
    let (x, y, z) = (normal(), normal(), normal())
    return [x, y, z]
  }
}
