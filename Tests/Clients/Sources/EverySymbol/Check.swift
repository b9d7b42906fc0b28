import Foundation

/// Ends the program where something is not as it has to be.
func check(_ condition: Bool, _ what: String, line: Int = #line) {
  guard !condition else { return }
  print("line \(line): \(what)")
  exit(1)
}
