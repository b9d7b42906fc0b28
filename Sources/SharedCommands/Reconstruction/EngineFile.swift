import Foundation

/// A file that an engine makes of a run when it has ended, whether it failed or not.
package struct EngineFile: Sendable {
  /// As in the event `written`.
  package var kind: String
  package var url: URL
  package var content: Data

  package init(kind: String, url: URL, content: Data) {
    (self.kind, self.url, self.content) = (kind, url, content)
  }
}
