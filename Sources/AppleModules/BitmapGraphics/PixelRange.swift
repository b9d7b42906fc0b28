import Foundation

/// The pixels that an interval touches, clamped to `0..<count`.
func pixelRange(_ lower: CGFloat, _ upper: CGFloat, _ count: Int) -> Range<Int> {
  guard lower < upper else { return 0..<0 }
  // An edge closer than this to a pixel boundary counts as on it.
  let tolerance = 1e-6
  let first = min(max((lower + tolerance).rounded(.down), 0), CGFloat(count))
  let last = min(max((upper - tolerance).rounded(.up), 0), CGFloat(count))
  return Int(first)..<max(Int(first), Int(last))
}
