import ArgumentParser
import Foundation

/// Options of `reconstruct` that only one engine has.
package protocol EngineArguments: ParsableArguments {
  /// Throws a `CommandFailure` if the options don't fit the model.
  func check(_ output: ModelOutput, _ detail: DetailArguments) throws
  /// The files to write besides those that every engine writes. Throws a `CommandFailure` if one,
  /// or one of `files`, can't be written.
  func outputs(with model: ModelOutput) throws -> EngineOutputs
  /// Sets up a session that reads the folder `photos`.
  func configure(_ session: PhotogrammetrySession, photos: URL) throws
  /// What is written at the end of a run of the photos in `photos`, whether it failed or not.
  func files(
    of session: PhotogrammetrySession, photos: URL, model: ModelOutput
  ) throws -> [EngineFile]
}
