/// One call of `process`, with everything that the engine needs.
struct EngineTask: Sendable {
  var input: SessionInput
  var configuration: PhotogrammetrySession.Configuration
  var options: EngineOptions
  var plan: RunPlan
}
