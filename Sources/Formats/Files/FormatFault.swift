/// What is wrong with a file, as the end of a sentence; readers of files add the path.
struct FormatFault: Error {
  var reason: String

  init(_ reason: String) { self.reason = reason }
}
