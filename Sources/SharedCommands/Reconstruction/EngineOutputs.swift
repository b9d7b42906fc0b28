import ArgumentParser
import Foundation

/// Files that only some engines write with a model.
package struct EngineOutputs: Equatable, Sendable {
  /// A picture of the model, written with it.
  package var preview: URL?

  /// Creates a list of files; nil means that the file is not written.
  package init(preview: URL? = nil) { self.preview = preview }
}
