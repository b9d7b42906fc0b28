/// What is wrong with a PLY file, as the end of a sentence.
struct PLYFault: Error {
  var reason: String

  init(_ reason: String) { self.reason = reason }
}
