extension Int {
  /// The integer nearest to a number that may come from a file or an option: the nearest bound if
  /// the number is out of range, 0 if it is not a number.
  package init(saturating number: Double) {
    let rounded = number.rounded()
    self = Int(exactly: rounded) ?? (rounded.isNaN ? 0 : rounded > 0 ? .max : .min)
  }
}
