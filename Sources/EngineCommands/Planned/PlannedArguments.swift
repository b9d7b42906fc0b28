/// The arguments of a command that its chunks share.
enum PlannedArguments {
  /// Options that only the command itself has, with the number of their values.
  private static let excluded = [
    "--slurm": 0, "--partition": 1, "--account": 1, "--slurm-options": 1, "--plan": 1, "--json": 0,
    "--quiet": 0, "--threads": 1, "--checkpoint-directory": 1, "--photos-per-chunk": 1,
  ]

  /// The arguments after the program's name, `all`, without those that only the command itself has;
  /// they begin with the name of the subcommand.
  static func shared(_ all: [String]) -> [String] {
    var words: [String] = []
    var rest = all.dropFirst()
    while let word = rest.popFirst() {
      let name = word.prefix { $0 != "=" }
      guard let values = excluded[String(name)] else {
        words.append(word)
        continue
      }
      if name == word { rest = rest.dropFirst(values) }
    }
    return words.first == "reconstruct" ? words : ["reconstruct"] + words
  }
}
