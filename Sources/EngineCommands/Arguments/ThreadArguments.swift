import ArgumentParser
import Pipeline

/// The number of threads.
struct ThreadArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      "Number of threads; does not affect the result. (default: all usable processors)",
      valueName: "count"))
  var threads: Int?

  func validate() throws {
    if let threads, threads < 1 || threads > 1024 {
      throw ValidationError("--threads must be from 1 to 1024.")
    }
  }

  /// The number of threads to use.
  var threadCount: Int { threads ?? ProcessorShare.current.threads }
}
