/// What a valid file uses and this module can't read; readers of files add the path.
struct UnsupportedFeature: Error {
  /// The end of a sentence.
  var reason: String
  /// A sentence.
  var remedy: String
}
