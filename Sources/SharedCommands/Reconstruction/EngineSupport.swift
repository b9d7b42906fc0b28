import ArgumentParser
import Formats
import Foundation

/// An engine behind `PhotogrammetrySession`, as far as the command line depends on it.
package protocol EngineSupport: Sendable {
  /// Options of `reconstruct` that only this engine has.
  associatedtype Arguments: EngineArguments

  /// Subcommands besides `reconstruct`.
  static var commands: [any ParsableCommand.Type] { get }
  /// Formats of model files that the engine writes.
  static var modelFormats: [ModelFormat] { get }
  /// Sections of the help of `reconstruct`.
  static var help: EngineHelp { get }
  /// The source of log messages that repeat outputs of the session; nil if it logs none.
  static var sessionOutputSource: String? { get }
  /// The reason why this machine can't reconstruct, if sessions are not supported.
  static var unsupportedMachine: CommandFailure { get }

  /// The engine and the libraries in it with their versions, one per line.
  static var versions: String { get }

  /// What `path`, the first argument of `reconstruct`, names. Throws a `CommandFailure` if it can't
  /// be used.
  static func input(_ path: String) throws -> PhotoInput
  /// The photos that are made of a video, if `input` finds one. Throws a `CommandFailure`.
  static func photos(
    of video: URL, _ arguments: ReconstructArguments<Arguments>, _ reporter: RunReporter
  ) throws -> InputPhotos

  /// Prepares the process of the command line; called once, before any command.
  static func prepareProcess()
  /// Whether another attempt may succeed after `error`.
  static func isTransient(_ error: any Error) -> Bool
  /// Intrinsics of a photo's camera; nil if the engine does not provide them.
  static func intrinsics(of pose: PhotogrammetrySession.Pose) -> PosesFile.Intrinsics?
  /// Adds the number of photos, registered photos and triangles to the event `complete`.
  static func addCounts(of session: PhotogrammetrySession, to event: inout RunEvent)
  /// The reasons why the finished model may not show the object, as sentences.
  static func concerns(about session: PhotogrammetrySession) -> [String]
  /// Does what some arguments ask for instead of a run of the photos in `photos`; returns false if
  /// there are none. Throws a `CommandFailure`.
  static func runInstead(
    _ arguments: ReconstructArguments<Arguments>, photos: URL, output: ModelOutput,
    _ reporter: RunReporter
  ) async throws -> Bool
}
