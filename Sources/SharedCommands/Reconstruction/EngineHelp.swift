import ArgumentParser

/// Sections of the help of `reconstruct` that depend on the engine; empty if it adds nothing.
package struct EngineHelp: Sendable {
  /// Further command lines of the section on examples.
  package var examples = ""
  /// The formats of models.
  package var outputs = ""
  /// Sections on masks and the scale.
  package var input = ""
  /// Further lines of the section on events.
  package var events = ""

  package init() {}
}
