import Foundation

/// Ends the program if a condition does not hold.
func check(_ condition: Bool, _ what: String, line: Int = #line) {
  guard !condition else { return }
  print("line \(line): \(what)")
  exit(1)
}
