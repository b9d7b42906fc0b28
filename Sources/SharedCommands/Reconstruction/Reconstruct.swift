import ArgumentParser

/// Makes a model from a folder of photos with `Engine`.
package struct Reconstruct<Engine: EngineSupport>: AsyncParsableCommand {
  package static var configuration: CommandConfiguration {
    CommandConfiguration(
      commandName: "reconstruct",
      abstract: "Reconstruct an object from photos.",
      usage: """
        photogrammetry-cli <input-folder> <output> [options]
        """,
      discussion: ReconstructHelp.discussion(Engine.help))
  }

  @OptionGroup package var arguments: ReconstructArguments<Engine.Arguments>

  package init() {}

  package mutating func run() async throws {
    arguments.logging.bootstrap(sessionOutputSource: Engine.sessionOutputSource)
    let reporter = RunReporter(arguments.logging.style(json: arguments.json))
    do {
      try await ReconstructionJob<Engine>(arguments).run(reporter)
    } catch {
      let failure = CommandFailure(error, isTransient: Engine.isTransient(error))
      reporter.failed(failure)
      throw failure
    }
  }
}
