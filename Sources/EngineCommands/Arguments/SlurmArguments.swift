import ArgumentParser
import Foundation
import SharedCommands

/// Options that divide the work among the machines of a Slurm cluster.
struct SlurmArguments: ParsableArguments {
  @Flag(
    name: .long,
    help: "Run as job arrays on a Slurm cluster, and show their progress; see above.")
  var slurm = false

  @Option(
    name: .long,
    help: ArgumentHelp("Slurm's partition. (default: the cluster's)", valueName: "name"))
  var partition: String?

  @Option(
    name: .long,
    help: ArgumentHelp("The account to which Slurm charges the jobs.", valueName: "name"))
  var account: String?

  // Their first character is usually a hyphen.
  @Option(
    name: .long, parsing: .unconditional,
    help: ArgumentHelp(
      "Further options of sbatch, such as '--qos=night --exclude=node7'.", valueName: "options"))
  var slurmOptions: String?

  @Option(
    name: .customLong("plan"),
    help: ArgumentHelp(
      "The folder for the plan, logs and results of the chunks. Without --slurm the plan is only "
        + "written, for other schedulers.", valueName: "folder"),
    completion: .directory)
  var planFolder: String?

  func validate() throws {
    guard slurm || (partition == nil && account == nil && slurmOptions == nil) else {
      throw ValidationError("--partition, --account and --slurm-options need --slurm.")
    }
  }

  /// Whether the work is divided into chunks.
  var isUsed: Bool { slurm || planFolder != nil }

  /// The options of `sbatch` for every job.
  var batchOptions: [String] {
    (partition.map { ["--partition=\($0)"] } ?? []) + (account.map { ["--account=\($0)"] } ?? [])
      + Self.words(of: slurmOptions ?? "")
  }

  /// The words of a text, which may be quoted as in a shell.
  static func words(of text: String) -> [String] {
    var (words, word, quote) = ([String](), String?.none, Character?.none)
    for character in text {
      if let open = quote {
        if character == open { quote = nil } else { word = (word ?? "") + String(character) }
      } else if character == "'" || character == "\"" {
        (quote, word) = (character, word ?? "")
      } else if character.isWhitespace {
        if let complete = word { words.append(complete) }
        word = nil
      } else {
        word = (word ?? "") + String(character)
      }
    }
    return words + (word.map { [$0] } ?? [])
  }

  /// What help says about chunks.
  static let help = """
    MANY MACHINES
      --slurm divides the work into chunks, submits them as job arrays, and shows the progress.
      All machines must see the folders and the program at the same paths. The jobs continue
      without the command: the same command again shows the progress, or resumes. Ctrl-C ends the
      display, a second one cancels the jobs. Failed chunks are made again, with more memory if
      that was the reason. --plan writes the chunks to a folder without Slurm; 'photogrammetry-cli
      chunk --help' shows how other schedulers make them.

    """
}
