import Foundation

/// A color with alpha.
public final class CGColor: Hashable, Sendable {
  /// The color components and alpha, each 0…1.
  public let components: [CGFloat]?
  /// The color space of the components.
  public let colorSpace: CGColorSpace?

  /// Creates a gray.
  public convenience init(gray: CGFloat, alpha: CGFloat) {
    self.init([gray, alpha], CGColorSpaceCreateDeviceGray())
  }

  /// Creates a color from RGB components; these are taken as sRGB.
  public convenience init(red: CGFloat, green: CGFloat, blue: CGFloat, alpha: CGFloat) {
    self.init([red, green, blue, alpha], CGColorSpaceCreateDeviceRGB())
  }

  /// Creates a color in sRGB, the space of all colors here.
  public convenience init(
    srgbRed red: CGFloat, green: CGFloat, blue: CGFloat, alpha: CGFloat
  ) { self.init(red: red, green: green, blue: blue, alpha: alpha) }

  init(_ components: [CGFloat], _ space: CGColorSpace) {
    self.components = components
    colorSpace = space
  }

  /// The alpha component, 0…1: 0 is transparent, 1 is opaque.
  public var alpha: CGFloat { components?.last ?? 0 }

  /// Opaque black.
  public static let black = CGColor(gray: 0, alpha: 1)
  /// Opaque white.
  public static let white = CGColor(gray: 1, alpha: 1)
  /// Transparent black.
  public static let clear = CGColor(gray: 0, alpha: 0)

  /// Whether both have the same components.
  public static func == (lhs: CGColor, rhs: CGColor) -> Bool { lhs.components == rhs.components }

  /// Hashes the components.
  public func hash(into hasher: inout Hasher) { hasher.combine(components) }

  /// The color as 8-bit components, not premultiplied.
  var bytes: PixelValue {
    let values = (components ?? []).map { UInt8((min(max($0, 0), 1) * 255).rounded()) }
    switch values.count {
    case 2: return PixelValue(values[0], values[0], values[0], values[1])
    case 4: return PixelValue(values[0], values[1], values[2], values[3])
    default: return PixelValue(0, 0, 0, 0)
    }
  }
}

/// A color with 8 bits per component, not premultiplied by alpha.
struct PixelValue: Hashable, Sendable {
  var red: UInt8
  var green: UInt8
  var blue: UInt8
  var alpha: UInt8

  init(_ red: UInt8, _ green: UInt8, _ blue: UInt8, _ alpha: UInt8) {
    (self.red, self.green, self.blue, self.alpha) = (red, green, blue, alpha)
  }

  /// The luma with the weights of Rec. 601.
  var gray: UInt8 {
    if red == green, green == blue { return red }
    let sum = 299 * Int(red) + 587 * Int(green) + 114 * Int(blue)
    return UInt8((sum + 500) / 1000)
  }
}
