import ArgumentParser
import Foundation

#if canImport(Kernels)
  import Kernels
#endif

@main
struct PhotogrammetryCLI: AsyncParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "photogrammetry-cli",
    abstract: "Photos in, a textured 3-D model out.",
    discussion: """
      Reconstructs an object from photos taken all around it:

        photogrammetry-cli photos/ model.usdz

      'reconstruct' is meant when no subcommand is named; \
      'photogrammetry-cli reconstruct --help' tells everything about it.

      Exit codes: 0 all that was asked for was written, 1 the run failed, 2 the command line can't \
      be carried out, 130 interrupted.
      """,
    subcommands: subcommands, defaultSubcommand: Reconstruct.self)

  private static var subcommands: [any ParsableCommand.Type] {
    #if canImport(Pipeline)
      [
        Reconstruct.self, Batch.self, Align.self, Densify.self, Export.self, Inspect.self,
        Evaluate.self,
      ]
    #else
      [Reconstruct.self, Evaluate.self]
    #endif
  }

  /// Runs the command that the arguments name and ends the process with its exit code.
  static func main() async {
    Terminal.shared.ignoreBrokenPipes()
    #if canImport(Kernels)
      NativeLibraries.silence()
    #endif
    do {
      try await execute()
    } catch {
      end(with: error)
    }
  }

  private nonisolated static func execute() async throws {
    var command = try parseAsRoot()
    if var asynchronous = command as? any AsyncParsableCommand {
      try await asynchronous.run()
    } else {
      try command.run()
    }
  }

  /// Help goes to stdout; everything else is an error.
  private static func end(with error: any Error) -> Never {
    let code = exitCode(for: error)
    if error is ExitCode { Foundation.exit(code.rawValue) }
    if let failure = error as? CommandFailure {
      Terminal.shared.message("error: \(failure.sentence)")
      Foundation.exit(failure.exitCode)
    }
    if code == .success {
      Terminal.shared.result(fullMessage(for: error))
      Foundation.exit(0)
    }
    if code == .validationFailure {
      Terminal.shared.message(fullMessage(for: error))
      Foundation.exit(CommandFailure.usageCode)
    }
    Terminal.shared.message("error: \(sentence(for: error))")
    Foundation.exit(CommandFailure.runCode)
  }
}
