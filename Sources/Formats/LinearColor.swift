import Foundation
import SceneModel

/// A color whose components are proportional to light, 0…1.
package struct LinearColor: Sendable {
  package var components: SIMD3<Float>

  package init(_ components: SIMD3<Float>) { self.components = components }

  /// The linear color of components in sRGB, 0…1.
  package init(sRGB components: SIMD3<Float>) {
    func linear(_ value: Float) -> Float {
      value <= 0.04045 ? value / 12.92 : pow((value + 0.055) / 1.055, 2.4)
    }
    self.init([linear(components.x), linear(components.y), linear(components.z)])
  }

  /// The color in sRGB, 0…255.
  package var bytes: SIMD3<UInt8> {
    [Self.byte(components.x), Self.byte(components.y), Self.byte(components.z)]
  }

  private static func byte(_ value: Float) -> UInt8 {
    guard value > 0 else { return 0 }
    let linear = min(value, 1)
    let encoded = linear <= 0.003_130_8 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055
    return UInt8((encoded * 255).rounded())
  }
}
