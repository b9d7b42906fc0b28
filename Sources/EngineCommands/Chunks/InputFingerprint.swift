import Foundation
import Kernels

/// Identifies the input of a model: files and options.
enum InputFingerprint {
  /// A hash of files and options as 16 hexadecimal digits.
  ///
  /// Files are identified by name, size and modification time; hashing their contents would make
  /// skipping finished work slow.
  static func text(of files: [URL], options: [String]) -> String {
    var fingerprint = Fingerprint()
    for option in options { fingerprint.add(Array(option.utf8)) }
    for file in files {
      let attributes = try? FileManager.default.attributesOfItem(
        atPath: file.resolvingSymlinksInPath().path)
      fingerprint.add(Array(file.lastPathComponent.utf8))
      fingerprint.add((attributes?[.size] as? NSNumber)?.intValue ?? -1)
      let time = attributes?[.modificationDate] as? Date
      fingerprint.add(time?.timeIntervalSinceReferenceDate ?? 0)
    }
    let digits = String(fingerprint.value, radix: 16)
    return String(repeating: "0", count: 16 - digits.count) + digits
  }
}
