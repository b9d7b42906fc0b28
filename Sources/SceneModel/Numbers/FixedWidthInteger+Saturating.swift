extension FixedWidthInteger {
  /// The integer nearest to a number that may come from a file or an option: the nearest bound if
  /// the number is out of range, 0 if it is not a number.
  @inlinable package init(saturating number: some BinaryFloatingPoint) {
    let rounded = number.rounded()
    self = Self(exactly: rounded) ?? (rounded.isNaN ? 0 : rounded > 0 ? .max : .min)
  }
}
