import Foundation
import SceneModel

extension Quaternion {
  /// Rotations that cover all orientations evenly: the spiral of Alexa, "Super-Fibonacci spirals:
  /// fast, low-discrepancy sampling of SO(3)", CVPR 2022.
  static func spread(_ count: Int) -> [Quaternion] {
    // The constants of equation 6.
    let (phi, psi) = (2.0.squareRoot(), 1.533_751_168_755_204_288_118_041)
    return (0..<count).map { index in
      let s = Double(index) + 0.5
      let t = s / Double(count)
      let (r, q) = (t.squareRoot(), (1 - t).squareRoot())
      let (alpha, beta) = (2 * Double.pi * s / phi, 2 * Double.pi * s / psi)
      return Quaternion(x: r * sin(alpha), y: r * cos(alpha), z: q * sin(beta), w: q * cos(beta))
    }
  }
}
