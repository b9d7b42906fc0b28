extension [String] {
  /// The names, separated by commas; of more than `maximumCount` only the first, and the number of
  /// the others.
  func list(_ maximumCount: Int = 5) -> String {
    let shown = prefix(maximumCount).joined(separator: ", ")
    return count > maximumCount ? "\(shown) and \(count - maximumCount) more" : shown
  }
}
