// swift-format-ignore-file: NoLeadingUnderscores
import Foundation

// Programs read numbers in dictionaries with `as? CGFloat`. On Linux Foundation bridges every other
// numeric type from `NSNumber`, but not this one.
extension CGFloat: @retroactive _ObjectiveCBridgeable {
  /// The value as an `NSNumber`.
  public func _bridgeToObjectiveC() -> NSNumber { NSNumber(value: Double(self)) }

  /// Converts from an `NSNumber`.
  public static func _forceBridgeFromObjectiveC(_ source: NSNumber, result: inout CGFloat?) {
    result = CGFloat(source.doubleValue)
  }

  /// Converts from an `NSNumber`; never fails.
  public static func _conditionallyBridgeFromObjectiveC(
    _ source: NSNumber, result: inout CGFloat?
  ) -> Bool {
    result = CGFloat(source.doubleValue)
    return true
  }

  /// Converts from an `NSNumber`; nil becomes 0.
  public static func _unconditionallyBridgeFromObjectiveC(_ source: NSNumber?) -> CGFloat {
    CGFloat(source?.doubleValue ?? 0)
  }
}
