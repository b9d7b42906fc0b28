import Combine
import Foundation
import RealityKit

/// The state of a reconstruction as an app displays it, without the app.
@MainActor
final class ReconstructionModel: ObservableObject {
  enum Phase: Equatable {
    case idle
    case running(String)
    case done(URL)
    case failed(String)
  }

  @Published private(set) var phase = Phase.idle
  @Published private(set) var fraction = 0.0
  private var session: PhotogrammetrySession?
  private var follower: Task<Void, Never>?

  func start(photos: URL, model: URL) {
    guard photos.startAccessingSecurityScopedResource() else {
      phase = .failed("no access")
      return
    }
    do {
      let session = try PhotogrammetrySession(input: photos)
      self.session = session
      follower = Task { [weak self] in
        do {
          for try await output in session.outputs {
            guard let self else { break }
            self.take(output)
          }
        } catch { self?.phase = .failed(error.localizedDescription) }
        photos.stopAccessingSecurityScopedResource()
      }
      try session.process(requests: [.modelFile(url: model, detail: .preview)])
      phase = .running("reading")
    } catch { phase = .failed(error.localizedDescription) }
  }

  func stop() { session?.cancel() }

  private func take(_ output: PhotogrammetrySession.Output) {
    switch output {
    case .requestProgress(_, fractionComplete: let fraction): self.fraction = fraction
    case .requestProgressInfo(_, let info):
      if let stage = info.processingStage { phase = .running("\(stage)") }
    case .requestComplete(_, .modelFile(let url)): phase = .done(url)
    case .requestError(_, let error): phase = .failed(error.localizedDescription)
    case .processingCancelled: phase = .idle
    default: break
    }
  }
}

/// The same with Observation instead of publishers.
@MainActor @Observable
final class ObservedProgress {
  private(set) var percent = 0
  @ObservationIgnored var handles = Set<AnyCancellable>()

  func follow(_ model: ReconstructionModel) {
    model.$fraction.map { Int($0 * 100) }.removeDuplicates()
      .sink { [weak self] in self?.percent = $0 }.store(in: &handles)
  }
}

@main
struct ObservedModel {
  /// ObservedModel <photos> <model.usdz>
  @MainActor static func main() async {
    let model = ReconstructionModel()
    let progress = ObservedProgress()
    progress.follow(model)
    let failing = ReconstructionModel()
    failing.start(photos: URL(fileURLWithPath: "/nowhere"), model: URL(fileURLWithPath: "x.usdz"))
    print(failing.phase)
    model.start(
      photos: URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true),
      model: URL(fileURLWithPath: CommandLine.arguments[2]))
    for await phase in model.$phase.values {
      if case .failed(let reason) = phase { print(reason) }
      guard case .done(let url) = phase else { continue }
      print("published \(url.lastPathComponent) at \(progress.percent) %")
      break
    }
  }
}
