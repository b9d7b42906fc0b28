import ArgumentParser
import Foundation

/// Options of `reconstruct` that only one engine has.
package protocol EngineArguments: ParsableArguments {
  /// Whether to only check the input and print the plan.
  var isDryRun: Bool { get }

  /// Throws a `CommandFailure` if the options don't fit the model.
  func check(_ output: ModelOutput, _ detail: DetailArguments) throws
  /// The files to write besides those that every engine writes. Throws a `CommandFailure` if one
  /// can't be written.
  func outputs() throws -> EngineOutputs
  /// Sets up a session that reads the folder `photos`.
  func configure(_ session: PhotogrammetrySession, photos: URL) throws
  /// The run's report as JSON; nil if there is none.
  func report(of session: PhotogrammetrySession) throws -> Data?
}
