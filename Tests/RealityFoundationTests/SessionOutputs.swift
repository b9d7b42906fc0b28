import RealityFoundation

/// Processes requests and returns the outputs up to and including the end of processing.
func run(
  _ session: PhotogrammetrySession, _ requests: [PhotogrammetrySession.Request]
) async throws -> [PhotogrammetrySession.Output] {
  try session.process(requests: requests)
  return try await outputsUntilEnd(session.outputs)
}

/// Reads outputs up to and including the end of processing.
func outputsUntilEnd(
  _ sequence: PhotogrammetrySession.Outputs
) async throws -> [PhotogrammetrySession.Output] {
  var outputs: [PhotogrammetrySession.Output] = []
  for try await output in sequence {
    outputs.append(output)
    if ["processingComplete", "processingCancelled"].contains(name(of: output)) { break }
  }
  return outputs
}

/// The errors of failed requests.
func errors(in outputs: [PhotogrammetrySession.Output]) -> [any Error] {
  outputs.compactMap { if case .requestError(_, let error) = $0 { error } else { nil } }
}

/// The name of an output's case.
func name(of output: PhotogrammetrySession.Output) -> String {
  let text = String(describing: output)
  return String(text.prefix { $0.isLetter })
}

/// The request that an output is about.
func request(of output: PhotogrammetrySession.Output) -> PhotogrammetrySession.Request? {
  switch output {
  case .requestProgress(let request, _), .requestProgressInfo(let request, _),
    .requestError(let request, _), .requestComplete(let request, _):
    request
  default: nil
  }
}
