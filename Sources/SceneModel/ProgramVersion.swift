/// The version of this package, as `--version` prints it and releases are tagged.
package enum ProgramVersion {
  /// A semantic version (semver.org).
  package static let current = "1.0.0"
}
