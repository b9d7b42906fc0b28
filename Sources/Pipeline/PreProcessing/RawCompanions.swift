import Foundation
import ImageFiles

/// Finds the photos that cameras store along with raw files: `IMG_1.JPG` for `IMG_1.CR2`. Both show
/// the same, so the raw file, which takes far longer to decode, is not used.
struct RawCompanions {
  /// Files with a common name, by its lowercase stem.
  private let files: [String: [URL]]

  /// Finds names that occur more than once.
  init(_ files: [URL]) {
    self.files = Dictionary(grouping: files, by: Self.name).filter { $0.value.count > 1 }
  }

  /// The photo that stands in for a raw file: one of the same name that isn't raw and that
  /// `inspection` accepts. Nil for other files.
  func photo(insteadOf file: URL, _ inspection: PhotoInspection) -> URL? {
    guard let group = files[Self.name(file)], isRaw(file, inspection) == true else { return nil }
    return group.first {
      isRaw($0, inspection) == false && (try? inspection.run($0, sampleID: 0)) != nil
    }
  }

  /// Whether the content of a file is that of a raw file; nil if it can't be read.
  private func isRaw(_ file: URL, _ inspection: PhotoInspection) -> Bool? {
    (try? ImageCodec.contents(of: file, limits: inspection.options.limits))
      .map { CameraRawFile.isRaw($0) }
  }

  private static func name(_ file: URL) -> String {
    file.deletingPathExtension().lastPathComponent.lowercased()
  }
}
