import Foundation
import Kernels
import Pipeline

/// Identifies the input of a model: files and options.
enum InputFingerprint {
  /// A hash of files, by their attributes, and of options, as 16 hexadecimal digits.
  static func text(of files: [URL], options: [String]) -> String {
    var fingerprint = Fingerprint()
    for option in options { fingerprint.add(Array(option.utf8)) }
    for file in files { fingerprint.addAttributes(of: file) }
    return fingerprint.value.hexadecimalDigits
  }
}
