import ArgumentParser
import Foundation
import Pipeline
import SceneModel
import SharedCommands

/// Makes a chunk of a plan.
struct MakeChunk: AsyncParsableCommand {
  /// Exit code of a transient failure. Limit: `EX_TEMPFAIL` of `sysexits.h`.
  static let transientCode: Int32 = 75

  static let configuration = CommandConfiguration(
    commandName: "chunk",
    abstract: "Make a chunk of a plan, here or on another machine.",
    discussion: """
      'batch --plan' and 'reconstruct --plan' divide the work into chunks and write them to \
      plan.json in a folder that all machines share. A chunk may be made anywhere, in any order \
      within its stage, and again after any failure: one that is done is not repeated, one that \
      was interrupted is resumed, and the result is always the same. 'photogrammetry-cli join' \
      checks all chunks and completes the work.

      With --slurm nothing of this has to be done by hand. For other schedulers:

      EXAMPLES
        photogrammetry-cli batch sets/ models/ --plan plan/
            Writes the plan, with a stage 'datasets' of one chunk per dataset.
        photogrammetry-cli chunk plan/ datasets 3
            Makes the third chunk. In a job array the number may be omitted.
        seq 50 | parallel --sshloginfile nodes --retries 3 \\
            photogrammetry-cli chunk $PWD/plan/ datasets
            Makes fifty chunks on several machines with GNU parallel.
        photogrammetry-cli join plan/
            Checks all chunks, and writes the summary.

      FILES
        plan.json                    the chunks: arguments, files, time, memory
        status/datasets-0003.json    how the last attempt ended
        logs/datasets-0003.log       what its process printed

      Exit codes: 0 the chunk is done, 1 it failed, 2 invalid arguments or paths, 75 it failed, \
      but another attempt may succeed, 130 interrupted.
      """)

  @Argument(
    help: ArgumentHelp("The folder of the plan.", valueName: "plan"), completion: .directory)
  var plan: String

  @Argument(help: "The stage of the chunk.")
  var stage: String

  @Argument(help: "The number of the chunk, from 1. (default: that of the task in a job array)")
  var number: Int?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Number of threads; does not affect the result. (default: those of the job, or all usable "
        + "processors)", valueName: "count"))
  var threads: Int?

  @OptionGroup var logging: LoggingOptions

  func validate() throws {
    if let threads, threads < 1 || threads > 1024 {
      throw ValidationError("--threads must be from 1 to 1024.")
    }
  }

  mutating func run() async throws {
    logging.bootstrap()
    let folder = try PlanFolder(reading: URL(fileURLWithPath: plan, isDirectory: true))
    guard let number = number ?? Node.taskNumber else {
      throw CommandFailure.usage("Name the number of the chunk: this is no task of a job array.")
    }
    let id = ChunkID(stage: stage, number: number)
    let run = ChunkRun(
      id, of: folder,
      threads: threads ?? Node.processors.map { min($0, ProcessorShare.current.threads) })
    let interrupts = InterruptHandler { run.stop() }
    let reporter = Locked(RunReporter(logging.style()))
    let status = try await run.run { event in
      reporter.withLock { $0.update(event.progress) }
    }
    reporter.withLock { $0.finish() }
    try conclude(status, id, folder, wasInterrupted: interrupts.wasInterrupted)
  }

  private func conclude(
    _ status: ChunkStatus, _ id: ChunkID, _ folder: PlanFolder, wasInterrupted: Bool
  ) throws {
    guard status.status != .done else {
      status.outputs.map(\.path).forEach(Terminal.shared.result)
      return
    }
    let name = folder.plan[id]?.name ?? "\(id)"
    if wasInterrupted || status.status == .cancelled {
      throw CommandFailure.interrupted("\(name): \(ChildResult.resumeHint)")
    }
    var failure = CommandFailure.run(
      "\(name): \(status.error ?? "") The log is \(folder.log(of: id).relativePath).",
      isTransient: status.isTransient)
    if status.isTransient { failure.exitCode = Self.transientCode }
    throw failure
  }
}
