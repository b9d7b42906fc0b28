extension [Double] {
  /// The median of a sorted array: the mean of the two middle elements if their number is even; 0
  /// for an empty one.
  var median: Double {
    guard !isEmpty else { return 0 }
    return (self[(count - 1) / 2] + self[count / 2]) / 2
  }
}
