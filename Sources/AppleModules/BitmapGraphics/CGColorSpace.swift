// swift-format-ignore-file: AlwaysUseLowerCamelCase
@_exported import CoreFoundationTypes

/// What the components of pixels mean. Colours are never converted from one space to another: there
/// are gray pixels and colours, taken as sRGB.
public final class CGColorSpace: Hashable, Sendable {
  /// The name of the space; nil for those of the device.
  public let name: CFString?
  /// The kind of the space.
  public let model: CGColorSpaceModel

  /// Creates a space from its name; fails where the name is not one of those below.
  public convenience init?(name: CFString) {
    let grays = [Self.genericGrayGamma2_2, Self.linearGray, Self.extendedGray]
    let colours = [
      Self.sRGB, Self.linearSRGB, Self.extendedSRGB, Self.displayP3, Self.genericRGBLinear,
      Self.adobeRGB1998,
    ]
    guard grays.contains(name) || colours.contains(name) else { return nil }
    self.init(name: name, grays.contains(name) ? .monochrome : .rgb)
  }

  init(name: CFString?, _ model: CGColorSpaceModel) {
    self.name = name
    self.model = model
  }

  /// The number of components without opacity.
  public var numberOfComponents: Int { model == .monochrome ? 1 : 3 }

  /// The space of most photos.
  public static let sRGB: CFString = "kCGColorSpaceSRGB"
  /// sRGB without its curve.
  public static let linearSRGB: CFString = "kCGColorSpaceLinearSRGB"
  /// sRGB beyond its bounds.
  public static let extendedSRGB: CFString = "kCGColorSpaceExtendedSRGB"
  /// The space of newer displays and phones.
  public static let displayP3: CFString = "kCGColorSpaceDisplayP3"
  /// Colours without a curve.
  public static let genericRGBLinear: CFString = "kCGColorSpaceGenericRGBLinear"
  /// The wide space of cameras.
  public static let adobeRGB1998: CFString = "kCGColorSpaceAdobeRGB1998"
  /// Gray with a curve.
  public static let genericGrayGamma2_2: CFString = "kCGColorSpaceGenericGrayGamma2_2"
  /// Gray without a curve.
  public static let linearGray: CFString = "kCGColorSpaceLinearGray"
  /// Gray beyond its bounds.
  public static let extendedGray: CFString = "kCGColorSpaceExtendedGray"

  /// Whether both are the same space.
  public static func == (lhs: CGColorSpace, rhs: CGColorSpace) -> Bool {
    lhs.name == rhs.name && lhs.model == rhs.model
  }

  /// Hashes name and kind.
  public func hash(into hasher: inout Hasher) {
    hasher.combine(name)
    hasher.combine(model)
  }
}

/// The kinds of colour spaces.
public enum CGColorSpaceModel: Int32, Hashable, Sendable {
  /// Not known.
  case unknown = -1
  /// Gray.
  case monochrome
  /// Red, green and blue.
  case rgb
}

/// The colours of the device.
public func CGColorSpaceCreateDeviceRGB() -> CGColorSpace { CGColorSpace(name: nil, .rgb) }

/// The grays of the device.
public func CGColorSpaceCreateDeviceGray() -> CGColorSpace { CGColorSpace(name: nil, .monochrome) }
