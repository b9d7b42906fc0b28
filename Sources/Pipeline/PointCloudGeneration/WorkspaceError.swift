import Foundation

/// Why the dense stage can't store its intermediate results.
enum WorkspaceError: LocalizedError, Equatable, Sendable {
  case noSpace(folder: String, needed: Int, free: Int, isTemporary: Bool)
  case notWritable(folder: String, isTemporary: Bool)
  case changed(file: String)

  var errorDescription: String? {
    switch self {
    case .noSpace(let folder, let needed, let free, _):
      "\(folder) has room for \(Self.size(free)), and the patches of the views need "
        + "\(Self.size(needed))."
    case .notWritable(let folder, _):
      "\(folder) can't be written, and the patches of the views must go there."
    case .changed(let file):
      "\(file) was changed or deleted during the run."
    }
  }

  var recoverySuggestion: String? {
    switch self {
    case .noSpace(_, _, _, true):
      "Free some space, let TMPDIR name a folder on a larger disk, or choose a lower detail level."
    case .noSpace:
      "Free some space, name a folder on a larger disk, or choose a lower detail level."
    case .notWritable(_, true): "Let TMPDIR name a folder that you may write to."
    case .notWritable: "Name a folder that you may write to, or change its permissions."
    case .changed: "Start again: all other views are kept."
    }
  }

  private static func size(_ bytes: Int) -> String {
    let megabytes = (Double(bytes) / 1e6).rounded(.up)
    return megabytes < 1000
      ? "\(Int(megabytes)) MB" : "\((megabytes / 100).rounded(.up) / 10) GB"
  }
}
