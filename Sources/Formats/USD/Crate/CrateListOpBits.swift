/// Bits of the header of a list edit: the lists of items that follow it, in the order of `items`.
enum CrateListOpBits {
  static let isExplicit: UInt8 = 1 << 0
  static let hasExplicitItems: UInt8 = 1 << 1
  static let hasAddedItems: UInt8 = 1 << 2
  static let hasDeletedItems: UInt8 = 1 << 3
  static let hasOrderedItems: UInt8 = 1 << 4
  static let hasPrependedItems: UInt8 = 1 << 5
  static let hasAppendedItems: UInt8 = 1 << 6

  /// The lists in file order.
  static let items = [
    hasExplicitItems, hasAddedItems, hasPrependedItems, hasAppendedItems, hasDeletedItems,
    hasOrderedItems,
  ]
  /// The lists whose items are part of the result, apart from what weaker layers have.
  static let present = hasExplicitItems | hasAddedItems | hasPrependedItems | hasAppendedItems
}
