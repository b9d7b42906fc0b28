import ArgumentParser
import Foundation
import Kernels
import SharedCommands

/// Makes a model with `Engine` from photos that the program renders itself.
struct Demo<Engine: EngineSupport>: AsyncParsableCommand {
  static var configuration: CommandConfiguration {
    CommandConfiguration(
      commandName: "demo",
      abstract: "Make a model from photos that the program renders, to try it out.",
      discussion: """
        Renders 20 photos of a statue on a table, reconstructs the statue as 'reconstruct' does \
        with your photos, and prints what to try next. Takes less than a minute on two \
        processors; needs neither photos nor a network.

        EXAMPLES
          photogrammetry-cli demo
              Writes photos/, model.usdz and model.png into photogrammetry-demo/.
          photogrammetry-cli demo try/ -d medium
              Another folder, and more detail.

        The folder may hold an earlier demo, which is replaced, but no other files. With --json \
        the events are those of 'reconstruct'.

        Exit codes: 0 the model was written, 1 it could not be made, 2 invalid arguments, or \
        other files in the folder, 130 interrupted.
        """)
  }

  @Argument(help: "The folder for the photos and the model.", completion: .directory)
  var folder = "photogrammetry-demo"

  @Option(name: .shortAndLong, help: "Detail level of the model, as for 'reconstruct'.")
  var detail = DetailArgument.reduced

  @OptionGroup var threading: ThreadArguments

  @Flag(name: .long, help: "Report progress and results as JSON Lines on stdout.")
  var json = false

  @OptionGroup var logging: LoggingOptions

  mutating func run() async throws {
    let photos = DemoPhotos()
    let files = DemoFolder(folder)
    do {
      try files.create(photoCount: photos.count)
      try render(photos, to: files)
    } catch {
      // The events of a run end with one of its failure; `reconstruct` reports its own failures.
      RunReporter(logging.style(json: json)).failed(CommandFailure(error))
      throw error
    }
    var reconstruct = try Reconstruct<Engine>.parse(arguments(files))
    try await reconstruct.run()
    guard !json, !logging.quiet else { return }
    DemoGuide(files: files, photoCount: photos.count).lines.forEach(Terminal.shared.message)
  }
}

extension Demo {
  /// Throws a `CommandFailure` if it is interrupted.
  private func render(_ photos: DemoPhotos, to files: DemoFolder) throws {
    let flag = CancellationFlag()
    let interrupts = InterruptHandler { flag.cancel() }
    let showsProgress = !json && !logging.quiet
    if showsProgress {
      Terminal.shared.message("Rendering \(photos.count) photos of a statue.")
    }
    let control = KernelControl(threadCount: threading.threadCount, flag: flag) { fraction in
      guard showsProgress else { return }
      Terminal.shared.show(status: "rendering photos \(Int(fraction * 100)) %")
    }
    defer { Terminal.shared.show(status: "") }
    do {
      try photos.write(to: URL(fileURLWithPath: files.photos, isDirectory: true), control)
    } catch is CancellationError {}
    guard !interrupts.wasInterrupted else {
      throw CommandFailure.interrupted("Interrupted; no model was written.")
    }
  }

  /// The arguments of `reconstruct`. Paths may begin with a hyphen.
  private func arguments(_ files: DemoFolder) -> [String] {
    ["--detail", detail.rawValue, "--threads", "\(threading.threadCount)"]
      + ["--preview=\(files.picture)"] + (json ? ["--json"] : [])
      + (logging.quiet ? ["--quiet"] : []) + (logging.verbose ? ["--verbose"] : [])
      + ["--", files.photos, files.model]
  }
}
