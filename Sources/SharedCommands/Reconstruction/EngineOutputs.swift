import ArgumentParser
import Foundation

/// Files that only some engines write.
package struct EngineOutputs: Equatable, Sendable {
  /// A picture of the model, written with it.
  package var preview: URL?
  /// The report of the run.
  package var report: URL?

  /// Creates a list of files; nil means that the file is not written.
  package init(preview: URL? = nil, report: URL? = nil) {
    (self.preview, self.report) = (preview, report)
  }
}
