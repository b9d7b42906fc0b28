import Kernels
import Pipeline

/// What a session asks of the engine behind it; used on one thread.
protocol SessionEngine: AnyObject {
  /// Announces the models to come, so that shared stages work as finely as needed.
  func plan(for specifications: [DetailSpecification])
  /// Reads all photos and tells which are used.
  func ingest() throws -> PhotoTotals
  func poses() throws -> PhotogrammetrySession.Poses
  func pointCloud(_ specification: DetailSpecification) throws -> PhotogrammetrySession.PointCloud
  func bounds(_ specification: DetailSpecification) throws -> BoundingBox
  func modelEntity(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry
  ) throws -> ModelEntity
  func writeModel(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry,
    to url: URL
  ) throws
  /// Leaves what the run's files need at the end of a task, the report for one.
  func finishTask() throws
  /// Lets go of what can be made again, and uses at most so many pixels of a view from now on.
  func limitResolution(to viewPixels: Int)
  /// What was done so far.
  var report: RunReport? { get }
}

/// One call of `process`: everything that the engine needs to know.
struct EngineTask: Sendable {
  var input: SessionInput
  var configuration: PhotogrammetrySession.Configuration
  var options: EngineOptions
  var plan: RunPlan
}

extension SessionEngine {
  /// Does the work for one request of a plan.
  func result(
    for entry: RunPlan.Entry, of plan: RunPlan
  ) throws -> PhotogrammetrySession.Result {
    let specification = entry.specification ?? plan.finest
    switch entry.request {
    case .poses: return .poses(try poses())
    case .pointCloud: return .pointCloud(try pointCloud(plan.finest))
    case .bounds: return .bounds(try bounds(specification))
    case .modelFile(let url, _, let geometry):
      try writeModel(specification, geometry ?? .init(), to: url)
      return .modelFile(url)
    case .modelEntity(_, let geometry):
      return .modelEntity(try modelEntity(specification, geometry ?? .init()))
    }
  }
}
