import ArgumentParser
import Foundation
import SceneModel
import SharedCommands

#if APPLE_ENGINE
  private typealias Engine = AppleEngine
#else
  import EngineCommands

  private typealias Engine = PipelineEngine
#endif

@main
struct PhotogrammetryCLI: AsyncParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "photogrammetry-cli",
    abstract: "Reconstruct textured 3-D models from photos.",
    discussion: """
      Reconstructs an object from photos taken all around it:

        photogrammetry-cli photos/ model.usdz

      'reconstruct' is the default subcommand; see 'photogrammetry-cli reconstruct --help'.

      '--version --verbose' prints the versions of the libraries in the program, too.

      Exit codes: 0 all results were written, 1 the run failed or the model may not show the \
      object, 2 invalid arguments or paths, \
      130 interrupted.
      """,
    version: ProgramVersion.current,
    subcommands: [Reconstruct<Engine>.self] + Engine.commands,
    defaultSubcommand: Reconstruct<Engine>.self)

  /// Runs the command of the arguments and ends the process with its exit code.
  static func main() async {
    Terminal.shared.ignoreBrokenPipes()
    Engine.prepareProcess()
    if Set(CommandLine.arguments.dropFirst()) == ["--version", "--verbose"] {
      Terminal.shared.result("photogrammetry-cli \(ProgramVersion.current)\n" + Engine.versions)
      Foundation.exit(0)
    }
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

  /// Prints help and the version to stdout, errors to stderr, and exits.
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
    Terminal.shared.message("error: \(CommandFailure(error).sentence)")
    Foundation.exit(CommandFailure.runCode)
  }
}
