import Pipeline
import SceneModel

/// The state of a session as a value: takes events and returns outputs.
///
/// Independent of threads and files. Times are in seconds of any monotonic clock.
struct SessionState: Sendable {
  typealias Request = PhotogrammetrySession.Request
  typealias Output = PhotogrammetrySession.Output

  /// The phase of a session.
  enum Phase: Hashable, Sendable { case idle, ingesting, processing, cancelling }

  private(set) var phase = Phase.idle
  /// The requests that have not ended.
  private(set) var activeRequests: [Request] = []
  /// Whether all photos have been read, in this or an earlier call.
  private(set) var hasIngested = false

  private var plan: RunPlan?
  /// Nil until the photos have been read.
  private var photos: PhotoTotals?
  private var durations: StageDurationModel?
  private var estimator: ProgressEstimator?
  private var specification: DetailSpecification?
  /// The units of work that earlier calls have completed.
  private var known: Set<WorkUnit> = []
  private var reportedSamples: Set<Int> = []
  private var hasDownsampled = false
  private var hasReportedStitching = false
  private var lastReported: [Request: (fraction: Double, stage: PipelineStage)] = [:]

  /// Whether requests are being processed.
  var isProcessing: Bool { phase != .idle }

  /// Begins a plan for approximately `photoCount` photos, with tiles besides the models if
  /// `makesTiles` is set.
  mutating func begin(
    _ plan: RunPlan, photoCount: Int, threadCount: Int, makesTiles: Bool = false, at time: Double
  ) throws(ProcessingError) {
    guard phase == .idle else { throw .alreadyProcessing }
    phase = hasIngested ? .processing : .ingesting
    self.plan = plan
    activeRequests = plan.requests
    lastReported = [:]
    specification = nil
    let durations = StageDurationModel(
      photos: photos ?? .init(count: photoCount), finest: plan.finest, threadCount: threadCount,
      makesTiles: makesTiles)
    self.durations = durations
    estimator = ProgressEstimator(units: plan.units, at: time) { [known] in
      known.contains($0) ? 0 : durations.seconds(of: $0)
    }
  }

  /// Requests a stop; returns whether there is work to stop.
  mutating func cancel() -> Bool {
    guard phase == .ingesting || phase == .processing else { return false }
    phase = .cancelling
    return true
  }

  /// All photos have been read; these are used.
  mutating func ingested(_ photos: PhotoTotals) -> [Output] {
    guard phase == .ingesting else { return [] }
    phase = .processing
    hasIngested = true
    self.photos = photos
    if var durations {
      durations.photos = photos
      self.durations = durations
      estimator?.reweigh { [known] in known.contains($0) ? 0 : durations.seconds(of: $0) }
    }
    return [.inputComplete]
  }

  /// A photo is not used.
  mutating func rejected(_ photo: RejectedPhoto) -> [Output] {
    guard isWorking, reportedSamples.insert(photo.sampleID).inserted else { return [] }
    return photo.fault == .notRegistered
      ? [.skippedSample(id: photo.sampleID)]
      : [.invalidSample(id: photo.sampleID, reason: photo.reason)]
  }

  /// Photos are used at a lower resolution.
  mutating func downsampled() -> [Output] {
    guard isWorking, !hasDownsampled else { return [] }
    hasDownsampled = true
    return [.automaticDownsampling]
  }

  /// Only some of the photos could be registered together.
  mutating func stitchingIncomplete() -> [Output] {
    guard isWorking, !hasReportedStitching else { return [] }
    hasReportedStitching = true
    return [.stitchingIncomplete]
  }

  /// The work for one of the requests begins.
  mutating func began(_ entry: RunPlan.Entry) { specification = entry.specification }

  /// A stage of the current request has reached a fraction of its work.
  mutating func progressed(
    _ stage: PipelineStage, fraction: Double, at time: Double
  ) -> [Output] {
    guard isWorking else { return [] }
    let unit = WorkUnit(stage: stage, specification: specification ?? plan?.finest)
    estimator?.advance(unit, to: fraction, at: time)
    return entries(awaiting: unit).flatMap { progress(of: $0, in: stage) }
  }

  /// A stage of the current request has more work than was expected.
  mutating func extended(_ stage: PipelineStage, by factor: Double) -> [Output] {
    guard isWorking else { return [] }
    estimator?.extend(
      WorkUnit(stage: stage, specification: specification ?? plan?.finest), by: factor)
    return []
  }

  /// A request was completed.
  mutating func completed(
    _ entry: RunPlan.Entry, _ result: PhotogrammetrySession.Result, at time: Double
  )
    -> [Output]
  {
    guard isWorking, activeRequests.contains(entry.request) else { return [] }
    for unit in entry.units { estimator?.advance(unit, to: 1, at: time) }
    known.formUnion(entry.units)
    activeRequests.removeAll { $0 == entry.request }
    return [
      .requestProgress(entry.request, fractionComplete: 1), .requestComplete(entry.request, result),
    ]
  }

  /// A request failed.
  mutating func failed(_ entry: RunPlan.Entry, _ error: any Swift.Error) -> [Output] {
    guard isWorking, activeRequests.contains(entry.request) else { return [] }
    activeRequests.removeAll { $0 == entry.request }
    let needed = Set(
      plan?.entries.filter { activeRequests.contains($0.request) }.flatMap(\.units) ?? [])
    estimator?.remove { !needed.contains($0) }
    return [.requestError(entry.request, error)]
  }

  /// All work has ended, or has stopped after `cancel()`.
  mutating func finished() -> [Output] {
    guard phase != .idle else { return [] }
    let output: Output = phase == .cancelling ? .processingCancelled : .processingComplete
    phase = .idle
    activeRequests = []
    plan = nil
    estimator = nil
    return [output]
  }

  /// Forgets the work of earlier calls, because their engine was discarded.
  mutating func forgetWork() {
    known = []
    hasReportedStitching = false
  }

  private var isWorking: Bool { phase == .ingesting || phase == .processing }

  private func entries(awaiting unit: WorkUnit) -> [RunPlan.Entry] {
    plan?.entries.filter { $0.work.contains(unit) && activeRequests.contains($0.request) } ?? []
  }

  /// Reports the progress of a request if it has advanced by a thousandth or to another stage.
  private mutating func progress(of entry: RunPlan.Entry, in stage: PipelineStage) -> [Output] {
    guard let estimator else { return [] }
    let last = lastReported[entry.request]
    // 1 is reserved for completed requests.
    let fraction = max(last?.fraction ?? 0, min(estimator.fraction(of: entry.work), 0.999))
    if let last, fraction - last.fraction < 0.001, last.stage == stage { return [] }
    lastReported[entry.request] = (fraction, stage)
    let info = Output.ProgressInfo(
      estimatedRemainingTime: estimator.remainingSeconds(of: entry.work),
      processingStage: Output.ProcessingStage(stage))
    return [
      .requestProgress(entry.request, fractionComplete: fraction),
      .requestProgressInfo(entry.request, info),
    ]
  }
}

extension PhotogrammetrySession.Output.ProcessingStage {
  init(_ stage: PipelineStage) {
    switch stage {
    case .preProcessing: self = .preProcessing
    case .imageAlignment: self = .imageAlignment
    case .objectMasking, .pointCloudGeneration: self = .pointCloudGeneration
    case .meshGeneration: self = .meshGeneration
    case .textureMapping: self = .textureMapping
    case .optimization: self = .optimization
    }
  }
}
