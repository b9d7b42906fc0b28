import Kernels
import Pipeline

/// The engine of this package behind a session.
final class ReconstructionEngine: SessionEngine {
  static let make: SessionCore.EngineFactory = { task, flag, onEvent in
    ReconstructionEngine(task, flag, onEvent)
  }

  init(
    _ task: EngineTask, _ flag: CancellationFlag, _ onEvent: @escaping SessionCore.EventHandler
  ) {}

  private var missing: ProcessingError {
    .notAvailable("The reconstruction is not connected yet.", remedy: "Use a later version.")
  }

  func plan(for specifications: [DetailSpecification]) {}
  func ingest() throws -> Int { throw missing }
  func poses() throws -> PhotogrammetrySession.Poses { throw missing }
  func pointCloud(
    _ specification: DetailSpecification
  ) throws -> PhotogrammetrySession.PointCloud { throw missing }
  func bounds(_ specification: DetailSpecification) throws -> BoundingBox { throw missing }
  func writeModel(_ specification: DetailSpecification, to url: URL) throws { throw missing }
  func finishTask() throws {}
  var report: RunReport? { nil }
}
