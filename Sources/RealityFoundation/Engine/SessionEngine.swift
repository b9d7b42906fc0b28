import Pipeline

/// The engine behind a session; used on a single thread.
protocol SessionEngine: AnyObject {
  /// Announces the models that will be requested, so that shared stages work at the highest
  /// resolution needed.
  func plan(for specifications: [DetailSpecification])
  /// Reads all photos and returns the totals of those that are used.
  func ingest() throws -> PhotoTotals
  func poses() throws -> PhotogrammetrySession.Poses
  func pointCloud(_ specification: DetailSpecification) throws -> PhotogrammetrySession.PointCloud
  func bounds(_ specification: DetailSpecification) throws -> BoundingBox
  func modelEntity(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry
  ) throws -> ModelEntity
  /// Writes a model, with the preview in the options of the session if `hasPreview` is true.
  func writeModel(
    _ specification: DetailSpecification, _ geometry: PhotogrammetrySession.Request.Geometry,
    to url: URL, hasPreview: Bool
  ) throws
  /// Completes the run's files at the end of a task, for instance the report.
  func finishTask() throws
  /// Drops results that can be recomputed, and uses at most `viewPixels` pixels per view from now
  /// on.
  func limitResolution(to viewPixels: Int)
  /// The report of the run so far.
  var report: RunReport? { get }
  /// What the page of the report shows besides it; nil unless the options ask for it.
  func reportMaterial() -> ReportMaterial?
}

extension SessionEngine {
  /// Processes one request of a plan.
  func result(
    for entry: RunPlan.Entry, of plan: RunPlan
  ) throws -> PhotogrammetrySession.Result {
    let specification = entry.specification ?? plan.finest
    switch entry.request {
    case .poses: return .poses(try poses())
    case .pointCloud: return .pointCloud(try pointCloud(plan.finest))
    case .bounds: return .bounds(try bounds(specification))
    case .modelFile(let url, _, let geometry):
      try writeModel(
        specification, geometry ?? .init(), to: url, hasPreview: entry.request == plan.lastFile)
      return .modelFile(url)
    case .modelEntity(_, let geometry):
      return .modelEntity(try modelEntity(specification, geometry ?? .init()))
    }
  }
}
