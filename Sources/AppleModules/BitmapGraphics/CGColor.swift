import Foundation

/// A colour with opacity.
public final class CGColor: Hashable, Sendable {
  /// The components and the opacity, from 0 to 1.
  public let components: [CGFloat]?
  /// The space of the components.
  public let colorSpace: CGColorSpace?

  /// Creates a gray.
  public convenience init(gray: CGFloat, alpha: CGFloat) {
    self.init([gray, alpha], CGColorSpaceCreateDeviceGray())
  }

  /// Creates a colour.
  public convenience init(red: CGFloat, green: CGFloat, blue: CGFloat, alpha: CGFloat) {
    self.init([red, green, blue, alpha], CGColorSpaceCreateDeviceRGB())
  }

  /// Creates a colour of sRGB, which is what all colours are.
  public convenience init(
    srgbRed red: CGFloat, green: CGFloat, blue: CGFloat, alpha: CGFloat
  ) { self.init(red: red, green: green, blue: blue, alpha: alpha) }

  init(_ components: [CGFloat], _ space: CGColorSpace) {
    self.components = components
    colorSpace = space
  }

  /// How much of what is behind it the colour hides, from 0 to 1.
  public var alpha: CGFloat { components?.last ?? 0 }

  /// Black.
  public static let black = CGColor(gray: 0, alpha: 1)
  /// White.
  public static let white = CGColor(gray: 1, alpha: 1)
  /// Nothing.
  public static let clear = CGColor(gray: 0, alpha: 0)

  /// Whether both have the same components.
  public static func == (lhs: CGColor, rhs: CGColor) -> Bool { lhs.components == rhs.components }

  /// Hashes the components.
  public func hash(into hasher: inout Hasher) { hasher.combine(components) }

  /// The colour in bytes.
  var bytes: PixelValue {
    let values = (components ?? []).map { UInt8((min(max($0, 0), 1) * 255).rounded()) }
    switch values.count {
    case 2: return PixelValue(values[0], values[0], values[0], values[1])
    case 4: return PixelValue(values[0], values[1], values[2], values[3])
    default: return PixelValue(0, 0, 0, 0)
    }
  }
}

/// A colour that is not multiplied by its opacity.
struct PixelValue: Hashable, Sendable {
  var red: UInt8
  var green: UInt8
  var blue: UInt8
  var alpha: UInt8

  init(_ red: UInt8, _ green: UInt8, _ blue: UInt8, _ alpha: UInt8) {
    (self.red, self.green, self.blue, self.alpha) = (red, green, blue, alpha)
  }

  /// By the weights of Rec. 601.
  var gray: UInt8 {
    if red == green, green == blue { return red }
    let sum = 299 * Int(red) + 587 * Int(green) + 114 * Int(blue)
    return UInt8((sum + 500) / 1000)
  }
}
