/// Where the opacity of a pixel is, and whether the colours have been multiplied by it.
public enum CGImageAlphaInfo: UInt32, Hashable, Sendable {
  /// There is none.
  case none
  /// After colours that are multiplied by it.
  case premultipliedLast
  /// Before colours that are multiplied by it.
  case premultipliedFirst
  /// After the colours.
  case last
  /// Before the colours.
  case first
  /// There is none, but a byte for it after the colours.
  case noneSkipLast
  /// There is none, but a byte for it before the colours.
  case noneSkipFirst
  /// There is nothing else.
  case alphaOnly
}

/// How the components of a pixel lie in memory.
public struct CGBitmapInfo: OptionSet, Hashable, Sendable {
  /// The bits.
  public let rawValue: UInt32

  /// Creates the description from its bits.
  public init(rawValue: UInt32) { self.rawValue = rawValue }

  /// The bits that hold a `CGImageAlphaInfo`.
  public static let alphaInfoMask = CGBitmapInfo(rawValue: 0x1F)
  /// The components are floating-point numbers; there are no such bitmaps here.
  public static let floatComponents = CGBitmapInfo(rawValue: 1 << 8)
  /// The bits that hold the order of bytes.
  public static let byteOrderMask = CGBitmapInfo(rawValue: 0x7000)
  /// Components in the order of their names.
  public static let byteOrderDefault: CGBitmapInfo = []
  /// 16 bits, the lowest byte first; there are no such bitmaps here.
  public static let byteOrder16Little = CGBitmapInfo(rawValue: 1 << 12)
  /// 32 bits, the last component first.
  public static let byteOrder32Little = CGBitmapInfo(rawValue: 2 << 12)
  /// 16 bits, the highest byte first; there are no such bitmaps here.
  public static let byteOrder16Big = CGBitmapInfo(rawValue: 3 << 12)
  /// 32 bits, the first component first.
  public static let byteOrder32Big = CGBitmapInfo(rawValue: 4 << 12)
}

/// Where the components of an 8-bit pixel lie.
struct PixelLayout: Hashable, Sendable {
  /// The bytes of a pixel.
  var size: Int
  /// The places of red, green and blue, or of gray; empty where there is only opacity.
  var colours: [Int]
  /// The place of the opacity; nil where there is none.
  var alpha: Int?
  /// The place of a byte that means nothing.
  var unused: Int?
  /// Whether the colours have been multiplied by the opacity.
  var isPremultiplied = false
  /// What it was made from.
  var alphaInfo: CGImageAlphaInfo

  /// Nil for what can't be drawn into.
  init?(_ space: CGColorSpaceModel, _ info: CGBitmapInfo) {
    guard let alphaInfo = CGImageAlphaInfo(rawValue: info.rawValue & 0x1F),
      !info.contains(.floatComponents)
    else { return nil }
    self.alphaInfo = alphaInfo
    let order = info.intersection(.byteOrderMask)
    if alphaInfo == .alphaOnly {
      (size, colours, alpha) = (1, [], 0)
      return
    }
    if space == .monochrome {
      guard alphaInfo == .none else { return nil }
      (size, colours) = (1, [0])
      return
    }
    guard order == [] || order == .byteOrder32Big || order == .byteOrder32Little else { return nil }
    let isFirst: Bool
    switch alphaInfo {
    case .premultipliedFirst, .first, .noneSkipFirst: isFirst = true
    case .premultipliedLast, .last, .noneSkipLast: isFirst = false
    case .none, .alphaOnly: return nil
    }
    // As a big-endian number: the opacity is the first or the last byte of four.
    let places = isFirst ? [1, 2, 3, 0] : [0, 1, 2, 3]
    let stored = order == .byteOrder32Little ? places.map { 3 - $0 } : places
    (size, colours) = (4, Array(stored[..<3]))
    if alphaInfo == .noneSkipFirst || alphaInfo == .noneSkipLast {
      unused = stored[3]
    } else {
      alpha = stored[3]
    }
    isPremultiplied = alphaInfo == .premultipliedFirst || alphaInfo == .premultipliedLast
  }
}
