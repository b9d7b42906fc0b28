import Kernels
import Pipeline
import SceneModel

/// Combines the state of a session, its outputs and the thread that does the work.
final class SessionCore: SessionWorker {
  typealias EventHandler = @Sendable (PipelineEvent) -> Void
  typealias EngineFactory =
    @Sendable (EngineTask, CancellationFlag, @escaping EventHandler) throws -> any SessionEngine

  private struct Shared {
    var state = SessionState()
    var flag = CancellationFlag()
    var report: RunReport?
    var material: ReportMaterial?
  }

  /// The state of the session's thread.
  private struct WorkerState {
    var engine: (any SessionEngine)?
    /// The flag that the engine was made with.
    var flag: CancellationFlag?
  }

  let outputs = OutputBuffer()
  private let shared = Locked(Shared())
  private let input: SessionInput
  private let configuration: PhotogrammetrySession.Configuration
  private let makeEngine: EngineFactory
  private let thread = SerialThread(name: "photogrammetry") { WorkerState() }

  init(
    _ input: SessionInput, configuration: PhotogrammetrySession.Configuration,
    makeEngine: @escaping EngineFactory
  ) {
    self.input = input
    self.configuration = configuration
    self.makeEngine = makeEngine
  }

  var isProcessing: Bool { shared.withLock { $0.state.isProcessing } }
  var activeRequests: [PhotogrammetrySession.Request] {
    shared.withLock { $0.state.activeRequests }
  }
  var report: RunReport? { shared.withLock { $0.report } }
  var reportMaterial: ReportMaterial? { shared.withLock { $0.material } }

  func process(
    _ requests: [PhotogrammetrySession.Request], options: EngineOptions,
    keepingAlive session: AnyObject
  ) throws {
    try RequestValidation(input: input, configuration: configuration, options: options)
      .check(requests)
    EngineBuild.warnOnce
    try begin(
      EngineTask(
        input: input, configuration: configuration, options: options,
        plan: RunPlan(requests, configuration: configuration)),
      keepingAlive: session)
  }

  /// Begins a task on the session's thread.
  private func begin(_ task: EngineTask, keepingAlive session: AnyObject) throws {
    let session = KeepAlive(session)
    let flag = try shared.withLock { shared in
      try shared.state.begin(
        task.plan, photoCount: task.input.fileCount, threadCount: task.options.threadCount,
        makesTiles: task.options.tiles != nil, at: now())
      // A flag can't be reset: after a cancellation, a new flag and a new engine are made.
      if shared.flag.isCancelled {
        shared.flag = CancellationFlag()
        shared.state.forgetWork()
      }
      return shared.flag
    }
    thread.submit { worker in
      self.perform(task, flag, &worker)
      withExtendedLifetime(session) {}
    }
  }

  func cancel() {
    shared.withLock { if $0.state.cancel() { $0.flag.cancel() } }
  }

  func close() {
    shared.withLock { $0.flag.cancel() }
    thread.stop()
    outputs.finish()
  }

  private func perform(
    _ task: EngineTask, _ flag: CancellationFlag, _ worker: inout WorkerState
  ) {
    do {
      if worker.flag !== flag { worker = WorkerState(engine: nil, flag: flag) }
      try work(on: task, &worker.engine, flag)
    } catch is CancellationError {
      // `finished` reports it.
    } catch {
      for entry in task.plan.entries { fail(entry, error) }
    }
    if let engine = worker.engine { finishTask(engine) }
    emit { $0.finished() }
  }

  private func finishTask(_ engine: any SessionEngine) {
    do {
      try engine.finishTask()
    } catch {
      sessionLogger.warning("The report can't be written: \(sentence(of: error))")
    }
    // The material first: warnings about it belong into the report.
    let material = engine.reportMaterial()
    let report = engine.report
    shared.withLock {
      $0.report = report ?? $0.report
      $0.material = material ?? $0.material
    }
  }

  private func work(
    on task: EngineTask, _ current: inout (any SessionEngine)?, _ flag: CancellationFlag
  ) throws {
    let plan = task.plan
    let engine = try current ?? makeEngine(task, flag) { [weak self] in self?.handle($0) }
    current = engine
    engine.plan(for: plan.specifications)
    let photos = try engine.ingest()
    sessionLogger.info("Ingestion done: \(photos.count) photos are used.")
    emit { $0.ingested(photos) }
    for entry in plan.entries {
      if flag.isCancelled { throw CancellationError() }
      shared.withLock { $0.state.began(entry) }
      do {
        let result = try result(for: entry, of: plan, engine)
        emit { $0.completed(entry, result, at: now()) }
      } catch let error as CancellationError {
        throw error
      } catch {
        fail(entry, error)
      }
    }
  }

  /// Processes a request; retries once, at half the resolution, if memory runs out.
  private func result(
    for entry: RunPlan.Entry, of plan: RunPlan, _ engine: any SessionEngine
  ) throws -> PhotogrammetrySession.Result {
    do {
      return try engine.result(for: entry, of: plan)
    } catch KernelError.outOfMemory {
      var entry = entry
      entry.specification = entry.specification?.halved
      engine.limitResolution(to: plan.finest.viewPixels / 2)
      emit { $0.downsampled() }
      return try engine.result(for: entry, of: plan)
    }
  }

  private func fail(_ entry: RunPlan.Entry, _ error: any Swift.Error) {
    let error: any Swift.Error =
      error is PhotogrammetrySession.Error ? error : ProcessingError(error)
    sessionLogger.error("\(entry.request) failed: \(sentence(of: error))")
    emit { $0.failed(entry, error) }
  }

  private func handle(_ event: PipelineEvent) {
    log(event)
    switch event {
    case .progress(let stage, let fraction):
      emit { $0.progressed(stage, fraction: fraction, at: now()) }
    case .extended(let stage, let factor): emit { $0.extended(stage, by: factor) }
    case .rejected(let photo): emit { $0.rejected(photo) }
    case .downsampled: emit { $0.downsampled() }
    case .stitchingIncomplete: emit { $0.stitchingIncomplete() }
    case .ingested, .warning, .detail: break
    }
  }

  /// Changes the state and appends the resulting outputs, in the same order for all threads.
  private func emit(_ change: (inout SessionState) -> [PhotogrammetrySession.Output]) {
    shared.withLock { for output in change(&$0.state) { outputs.append(output) } }
  }
}

/// Writes an event of the engine to the log.
private func log(_ event: PipelineEvent) {
  switch event {
  case .rejected(let photo):
    sessionLogger.warning("\(photo.reason)", source: sessionOutputSource)
  case .downsampled:
    sessionLogger.notice("Photos are used at a lower resolution to fit the memory.")
  case .stitchingIncomplete(let registered, let count):
    sessionLogger.warning(
      "Only \(registered) of \(count) photos could be registered together.",
      source: sessionOutputSource)
  case .warning(let sentence):
    sessionLogger.warning("\(sentence)")
  case .detail(let sentence):
    sessionLogger.debug("\(sentence)")
  case .progress, .extended, .ingested:
    break
  }
}

/// Seconds of a monotonic clock.
private func now() -> Double { ProcessInfo.processInfo.systemUptime }

/// Retains an object of any type while a job runs; only its lifetime is affected.
private struct KeepAlive: @unchecked Sendable {
  private let object: AnyObject

  init(_ object: AnyObject) { self.object = object }
}
