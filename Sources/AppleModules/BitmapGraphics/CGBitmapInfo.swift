/// Where the alpha component of a pixel is, and whether the color components are premultiplied by
/// it.
public enum CGImageAlphaInfo: UInt32, Hashable, Sendable {
  /// No alpha.
  case none
  /// Alpha after premultiplied color components.
  case premultipliedLast
  /// Alpha before premultiplied color components.
  case premultipliedFirst
  /// Alpha after the color components.
  case last
  /// Alpha before the color components.
  case first
  /// No alpha, but an unused byte after the color components.
  case noneSkipLast
  /// No alpha, but an unused byte before the color components.
  case noneSkipFirst
  /// Alpha only, no color components.
  case alphaOnly
}

/// How the components of a pixel are arranged in memory.
public struct CGBitmapInfo: OptionSet, Hashable, Sendable {
  /// The bits.
  public let rawValue: UInt32

  /// Creates the description from its bits.
  public init(rawValue: UInt32) { self.rawValue = rawValue }

  /// The bits that hold a `CGImageAlphaInfo`.
  public static let alphaInfoMask = CGBitmapInfo(rawValue: 0x1F)
  /// Floating-point components; not supported here.
  public static let floatComponents = CGBitmapInfo(rawValue: 1 << 8)
  /// The bits that hold the byte order.
  public static let byteOrderMask = CGBitmapInfo(rawValue: 0x7000)
  /// The default order: components in the order of their names.
  public static let byteOrderDefault: CGBitmapInfo = []
  /// 16-bit little-endian; not supported here.
  public static let byteOrder16Little = CGBitmapInfo(rawValue: 1 << 12)
  /// 32-bit little-endian: the last component first.
  public static let byteOrder32Little = CGBitmapInfo(rawValue: 2 << 12)
  /// 16-bit big-endian; not supported here.
  public static let byteOrder16Big = CGBitmapInfo(rawValue: 3 << 12)
  /// 32-bit big-endian: the first component first.
  public static let byteOrder32Big = CGBitmapInfo(rawValue: 4 << 12)
}

/// Byte offsets of the components in a pixel with 8 bits per component.
struct PixelLayout: Hashable, Sendable {
  /// The number of bytes per pixel.
  var size: Int
  /// The offsets of red, green and blue, or of gray; empty for alpha-only pixels.
  var colorOffsets: [Int]
  /// The offset of alpha; nil if there is none.
  var alpha: Int?
  /// The offset of the unused byte; nil if there is none.
  var unused: Int?
  /// Whether the color components are premultiplied by alpha.
  var isPremultiplied = false
  /// The alpha info that the layout was created from.
  var alphaInfo: CGImageAlphaInfo

  /// Fails for layouts that can't be drawn into.
  init?(_ space: CGColorSpaceModel, _ info: CGBitmapInfo) {
    guard let alphaInfo = CGImageAlphaInfo(rawValue: info.rawValue & 0x1F),
      !info.contains(.floatComponents)
    else { return nil }
    self.alphaInfo = alphaInfo
    let order = info.intersection(.byteOrderMask)
    if alphaInfo == .alphaOnly {
      (size, colorOffsets, alpha) = (1, [], 0)
      return
    }
    if space == .monochrome {
      guard alphaInfo == .none else { return nil }
      (size, colorOffsets) = (1, [0])
      return
    }
    guard order == [] || order == .byteOrder32Big || order == .byteOrder32Little else { return nil }
    let isFirst: Bool
    switch alphaInfo {
    case .premultipliedFirst, .first, .noneSkipFirst: isFirst = true
    case .premultipliedLast, .last, .noneSkipLast: isFirst = false
    case .none, .alphaOnly: return nil
    }
    // As a big-endian word: alpha is the first or the last of four bytes.
    let places = isFirst ? [1, 2, 3, 0] : [0, 1, 2, 3]
    let stored = order == .byteOrder32Little ? places.map { 3 - $0 } : places
    (size, colorOffsets) = (4, Array(stored[..<3]))
    if alphaInfo == .noneSkipFirst || alphaInfo == .noneSkipLast {
      unused = stored[3]
    } else {
      alpha = stored[3]
    }
    isPremultiplied = alphaInfo == .premultipliedFirst || alphaInfo == .premultipliedLast
  }
}
