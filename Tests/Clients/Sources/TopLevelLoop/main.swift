import Foundation
import RealityKit

// Only top-level code that awaits.

let arguments = CommandLine.arguments
let input = URL(fileURLWithPath: arguments[1], isDirectory: true)
let output = URL(fileURLWithPath: arguments[2])
var configuration = PhotogrammetrySession.Configuration()
configuration.sampleOrdering = .sequential

let session = try PhotogrammetrySession(input: input, configuration: configuration)
try session.process(requests: [
  .modelFile(url: output, detail: .preview), .modelEntity(detail: .preview), .bounds,
])

processing: for try await message in session.outputs {
  switch message {
  case .requestComplete(let request, let result):
    switch result {
    case .modelFile(let url): print("file", url.lastPathComponent)
    case .bounds(let box): print("bounds", box.extents)
    default: print("other result of", request)
    }
  case .requestError(let request, let error): print("error", request, error)
  case .processingComplete: break processing
  case .processingCancelled: break processing
  default: continue
  }
}
print("finished", session.isProcessing)
