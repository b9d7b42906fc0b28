import Foundation
import Kernels

extension Fingerprint {
  /// Adds a file by its name, size and time of modification: reading the contents of all files
  /// would take long. What is missing has a size of its own.
  package mutating func addAttributes(of file: URL) {
    let attributes = try? FileManager.default.attributesOfItem(
      atPath: file.resolvingSymlinksInPath().path)
    add(Array(file.lastPathComponent.utf8))
    add((attributes?[.size] as? NSNumber)?.intValue ?? -1)
    let time = attributes?[.modificationDate] as? Date
    add(time?.timeIntervalSinceReferenceDate ?? 0)
  }
}
