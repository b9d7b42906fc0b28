import Kernels

/// Inspections that other processes have made or will need, of the files of a folder.
struct InspectionUnits: Sendable {
  private let store: UnitStore
  /// Of the files and of the options.
  private let folderKey: UInt64

  init(_ store: UnitStore, folderKey: UInt64) {
    (self.store, self.folderKey) = (store, folderKey)
  }

  /// A block that another process made; nil if there is none.
  func find(_ range: Range<Int>) -> InspectionBlock? {
    store.find(.inspections, madeFrom: key(range))
  }

  /// The block, made now unless that was done.
  func block(_ range: Range<Int>, _ make: () throws -> InspectionBlock) throws {
    _ = try store.value(.inspections, madeFrom: key(range), make)
  }

  private func key(_ range: Range<Int>) -> UInt64 {
    var key = Fingerprint()
    key.add(folderKey)
    key.add(range.lowerBound)
    key.add(range.upperBound)
    return key.value
  }
}
