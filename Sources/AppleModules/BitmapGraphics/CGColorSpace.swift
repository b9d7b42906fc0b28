// swift-format-ignore-file: AlwaysUseLowerCamelCase
@_exported import CoreFoundationTypes

/// A color space. There is no conversion between spaces: pixels are gray or RGB, and RGB is taken
/// as sRGB.
public final class CGColorSpace: Hashable, Sendable {
  /// The name of the space; nil for device spaces.
  public let name: CFString?
  /// The color model of the space.
  public let model: CGColorSpaceModel

  /// Creates a space from one of the names below; fails for any other name.
  public convenience init?(name: CFString) {
    let grays = [Self.genericGrayGamma2_2, Self.linearGray, Self.extendedGray]
    let colors = [
      Self.sRGB, Self.linearSRGB, Self.extendedSRGB, Self.displayP3, Self.genericRGBLinear,
      Self.adobeRGB1998,
    ]
    guard grays.contains(name) || colors.contains(name) else { return nil }
    self.init(name: name, grays.contains(name) ? .monochrome : .rgb)
  }

  init(name: CFString?, _ model: CGColorSpaceModel) {
    self.name = name
    self.model = model
  }

  /// The number of components without alpha.
  public var numberOfComponents: Int { model == .monochrome ? 1 : 3 }

  /// sRGB, the space of most photos.
  public static let sRGB: CFString = "kCGColorSpaceSRGB"
  /// sRGB with a linear transfer function.
  public static let linearSRGB: CFString = "kCGColorSpaceLinearSRGB"
  /// sRGB with components beyond 0…1.
  public static let extendedSRGB: CFString = "kCGColorSpaceExtendedSRGB"
  /// Display P3, the wide-gamut space of newer displays and phones.
  public static let displayP3: CFString = "kCGColorSpaceDisplayP3"
  /// Generic RGB with a linear transfer function.
  public static let genericRGBLinear: CFString = "kCGColorSpaceGenericRGBLinear"
  /// Adobe RGB (1998), the wide-gamut space of many cameras.
  public static let adobeRGB1998: CFString = "kCGColorSpaceAdobeRGB1998"
  /// Gray with gamma 2.2.
  public static let genericGrayGamma2_2: CFString = "kCGColorSpaceGenericGrayGamma2_2"
  /// Gray with a linear transfer function.
  public static let linearGray: CFString = "kCGColorSpaceLinearGray"
  /// Gray with components beyond 0…1.
  public static let extendedGray: CFString = "kCGColorSpaceExtendedGray"

  /// Whether both have the same name and model.
  public static func == (lhs: CGColorSpace, rhs: CGColorSpace) -> Bool {
    lhs.name == rhs.name && lhs.model == rhs.model
  }

  /// Hashes name and model.
  public func hash(into hasher: inout Hasher) {
    hasher.combine(name)
    hasher.combine(model)
  }
}

/// Color models.
public enum CGColorSpaceModel: Int32, Hashable, Sendable {
  /// An unknown model.
  case unknown = -1
  /// Gray.
  case monochrome
  /// Red, green and blue.
  case rgb
}

/// The RGB space of the device, taken as sRGB.
public func CGColorSpaceCreateDeviceRGB() -> CGColorSpace { CGColorSpace(name: nil, .rgb) }

/// The gray space of the device.
public func CGColorSpaceCreateDeviceGray() -> CGColorSpace { CGColorSpace(name: nil, .monochrome) }
