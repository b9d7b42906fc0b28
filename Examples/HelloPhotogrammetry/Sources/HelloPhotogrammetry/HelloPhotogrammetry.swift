import Foundation
import RealityKit

/// Makes a model from a folder of photos and prints the progress.
///
///     HelloPhotogrammetry <photos> <model.usdz or folder/> [preview|reduced|medium|full|raw]
@main
struct HelloPhotogrammetry {
  static func main() async {
    do {
      let arguments = try Arguments(CommandLine.arguments.dropFirst())
      guard PhotogrammetrySession.isSupported else {
        throw Failure("This machine can't reconstruct models.")
      }
      let session = try PhotogrammetrySession(input: arguments.photos)
      try session.process(requests: [
        .modelFile(url: arguments.model, detail: arguments.detail)
      ])
      try await follow(session)
    } catch {
      print("error: \(error.localizedDescription)")
      exit(1)
    }
  }

  /// Handles the outputs until processing has ended; throws if the model was not made.
  private static func follow(_ session: PhotogrammetrySession) async throws {
    var failure: (any Error)?
    var percent = 0
    for try await output in session.outputs {
      switch output {
      case .inputComplete:
        print("The photos were read.")
      case .requestProgress(_, let fraction):
        // One line for every 10 %.
        guard Int(fraction * 10) > percent / 10 else { continue }
        percent = Int(fraction * 10) * 10
        print("\(percent) %")
      case .requestProgressInfo, .requestComplete(_, .bounds):
        continue
      case .requestComplete(_, .modelFile(let url)):
        print("Wrote \(url.path)")
      case .requestError(_, let error):
        failure = error
      case .invalidSample(let id, let reason):
        print("warning: photo \(id): \(reason)")
      case .skippedSample(let id):
        print("warning: photo \(id) was skipped")
      case .processingComplete:
        if let failure { throw failure }
        return
      case .processingCancelled:
        throw Failure("The session was canceled.")
      default:
        print(output.localizedDescription)
      }
    }
  }
}

/// The command-line arguments.
private struct Arguments {
  var photos: URL
  var model: URL
  var detail = PhotogrammetrySession.Request.Detail.reduced

  init(_ words: ArraySlice<String>) throws {
    let words = Array(words)
    guard words.count == 2 || words.count == 3 else {
      throw Failure("usage: HelloPhotogrammetry <photos> <model> [level]")
    }
    photos = URL(fileURLWithPath: words[0], isDirectory: true)
    model = URL(fileURLWithPath: words[1], isDirectory: words[1].hasSuffix("/"))
    guard words.count == 3 else { return }
    let levels: [String: PhotogrammetrySession.Request.Detail] = [
      "preview": .preview, "reduced": .reduced, "medium": .medium, "full": .full, "raw": .raw,
    ]
    guard let level = levels[words[2]] else { throw Failure("\(words[2]) is not a detail level.") }
    detail = level
  }
}

/// An error with a message.
private struct Failure: LocalizedError {
  var errorDescription: String?

  init(_ sentence: String) { errorDescription = sentence }
}
