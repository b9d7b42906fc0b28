/// The visibility of a value in the log.
///
/// A value is visible unless it is marked `private` or `sensitive`: the log of a Mac is shared by
/// all programs, but this one goes to the user's own terminal.
public struct OSLogPrivacy: Hashable, Sendable {
  /// What replaces a redacted value.
  public struct Mask: Hashable, Sendable {
    fileprivate let isHash: Bool

    /// A hash that is equal for equal values within one run.
    public static let hash = Mask(isHash: true)
    /// Only the placeholder `<private>`.
    public static let none = Mask(isHash: false)
  }

  fileprivate let isHidden: Bool
  fileprivate let mask: Mask

  /// Visible.
  public static let auto = OSLogPrivacy(isHidden: false, mask: .none)
  /// Visible.
  public static let `public` = OSLogPrivacy(isHidden: false, mask: .none)
  /// Redacted.
  public static let `private` = OSLogPrivacy(isHidden: true, mask: .none)
  /// Redacted.
  public static let sensitive = OSLogPrivacy(isHidden: true, mask: .none)

  /// Visible; the mask has no effect.
  public static func auto(mask: Mask) -> OSLogPrivacy { OSLogPrivacy(isHidden: false, mask: mask) }

  /// Redacted, replaced by the mask.
  public static func `private`(mask: Mask) -> OSLogPrivacy {
    OSLogPrivacy(isHidden: true, mask: mask)
  }

  /// Redacted, replaced by the mask.
  public static func sensitive(mask: Mask) -> OSLogPrivacy {
    OSLogPrivacy(isHidden: true, mask: mask)
  }

  func shown(_ text: String) -> String {
    guard isHidden else { return text }
    return mask.isHash ? "<mask.hash: \(String(text.hashValue.magnitude, radix: 16))>" : "<private>"
  }
}
