import Foundation

/// What the inspection of consecutive files found, which one process makes for others.
struct InspectionBlock: Sendable {
  /// Files per block. Chosen: some seconds for photos of 20 megapixels.
  static let fileCount = 64

  /// By file.
  var results: [Result<InspectedPhoto, Rejection>] = []

  /// The blocks of some files, as ranges of indices.
  static func ranges(ofCount count: Int) -> [Range<Int>] {
    stride(from: 0, to: count, by: fileCount).map { $0..<min($0 + fileCount, count) }
  }
}
