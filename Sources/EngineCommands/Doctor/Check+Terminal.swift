extension Check {
  /// What is wrong with the terminal or its encoding; nil if nothing is, or without a terminal.
  static func terminal(environment: [String: String], isTerminal: Bool) -> Check? {
    guard isTerminal else { return nil }
    let type = environment["TERM"] ?? ""
    if type.isEmpty || type == "dumb" {
      return Check(
        .terminal, .note, "The terminal can't redraw a line, so progress is printed in lines.",
        remedy: "Set TERM to its type, for instance: export TERM=xterm-256color")
    }
    // The first that is set and not empty counts, as in setlocale(3).
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"].compactMap { environment[$0] }.first { !$0.isEmpty }
    let encoding = locale?.lowercased().filter { $0 != "-" } ?? ""
    guard !encoding.contains("utf8") else { return nil }
    return Check(
      .terminal, .note,
      "The locale \(locale ?? "C") is not UTF-8: some characters and file names may look wrong.",
      remedy: "Use a UTF-8 locale: export LC_ALL=C.UTF-8")
  }
}
