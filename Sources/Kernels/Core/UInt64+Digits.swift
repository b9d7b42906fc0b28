extension UInt64 {
  /// The number as 16 hexadecimal digits, for hashes in text: some JSON readers round 64-bit
  /// numbers.
  package var hexadecimalDigits: String {
    let digits = String(self, radix: 16)
    return String(repeating: "0", count: 16 - digits.count) + digits
  }
}
