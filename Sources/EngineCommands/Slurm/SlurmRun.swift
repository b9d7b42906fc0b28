import Foundation
import Kernels
import Logging
import SharedCommands

/// Makes a plan on a Slurm cluster: submits the chunks of a stage as job arrays, and a job after
/// them that submits what follows.
///
/// That job and every command that shows the progress do the same, `advance()`, and may do it at
/// the same time: whatever is made twice is the same. So nothing depends on a process that has to
/// stay alive.
struct SlurmRun: Sendable {
  /// What `advance()` found.
  enum Advance: Equatable {
    /// Jobs were submitted.
    case submitted
    /// Chunks are still waiting or running.
    case waiting
    /// Nothing more can be made; some chunks of a stage may have failed.
    case ended(failed: [ChunkID])
  }

  /// What a stage lacks.
  private struct Gaps {
    var open: [ChunkID: SlurmSubmission.Resources] = [:]
    var failed: [ChunkID] = []
    var isActive = false
  }

  let folder: PlanFolder
  let settings: SlurmSettings
  private let slurm: Slurm
  private let files: SlurmFolder
  private let logger = Logger(label: "photogrammetry-cli")

  /// `settings` replace those of the plan. Throws a `CommandFailure` or `OutputError`.
  init(_ folder: PlanFolder, settings: SlurmSettings? = nil) throws {
    self.folder = folder
    slurm = try Slurm()
    files = try SlurmFolder(of: folder)
    if let settings { try files.write(settings) }
    self.settings = try settings ?? files.settings()
  }

  // MARK: - Jobs

  /// The start of the names of this plan's jobs.
  private var label: String {
    let hash = XXHash64.hash(Array(folder.url.standardizedFileURL.path.utf8))
    return "photogrammetry-\(hash.hexadecimalDigits)"
  }

  private func jobName(_ stage: String) -> String { "\(label)-\(stage)" }

  /// The name of the job that submits what follows.
  private var followUpName: String { jobName("join") }

  private var allNames: [String] {
    folder.plan.stages.map { jobName($0.name) } + [followUpName]
  }

  /// All jobs of the plan that wait or run.
  func jobs() throws -> [Slurm.Job] { try slurm.jobs(named: allNames) }

  /// The chunks in jobs.
  func active(_ jobs: [Slurm.Job]) -> [ChunkID: Slurm.Job] {
    let submissions = Dictionary(
      files.submissions().map { ($0.job, $0) }, uniquingKeysWith: { $1 })
    var active: [ChunkID: Slurm.Job] = [:]
    for job in jobs {
      guard let submission = submissions[job.id], let task = job.task,
        submission.numbers.indices.contains(task - 1)
      else { continue }
      active[ChunkID(stage: submission.stage, number: submission.numbers[task - 1])] = job
    }
    return active
  }

  /// Cancels all jobs of the plan.
  func cancel() throws { try slurm.cancel(named: [followUpName] + allNames) }

  /// Makes failed chunks count as new ones.
  func forgetFailures() { files.forgetSubmissions() }

  // MARK: - What is next

  /// Submits the chunks of the first stage that lacks some; none if they are being made, or can't
  /// be. Throws a `CommandFailure`.
  func advance() throws -> Advance {
    let active = active(try jobs())
    for stage in folder.isComplete ? [] : folder.plan.stages {
      let gaps = gaps(of: stage, active)
      if !gaps.open.isEmpty {
        try submit(gaps.open, of: stage)
        return .submitted
      }
      if gaps.isActive { return .waiting }
      if !gaps.failed.isEmpty, !stage.isPartial { return .ended(failed: gaps.failed) }
    }
    // The files of a machine that died may be incomplete.
    let damaged = folder.forgetDamaged()
    guard damaged.isEmpty else {
      logger.warning("Files of \(damaged.count) chunks are damaged; they are made again.")
      return try advance()
    }
    return .ended(failed: folder.missing)
  }

  private func gaps(of stage: ChunkStage, _ active: [ChunkID: Slurm.Job]) -> Gaps {
    let submissions = files.submissions().filter { $0.stage == stage.name }
    var gaps = Gaps()
    for id in folder.missing(in: stage) {
      let earlier = submissions.filter { $0.numbers.contains(id.number) }
      if active[id] != nil {
        gaps.isActive = true
      } else if let last = earlier.last {
        if let resources = resources(after: last, attempts: earlier.count, of: id) {
          gaps.open[id] = resources
        } else {
          gaps.failed.append(id)
        }
      } else {
        gaps.open[id] = resources(of: id)
      }
    }
    return gaps
  }

  /// What the first job of a chunk may use. The time is four times the usual one, at least ten
  /// minutes (chosen): the estimate is that of an idle machine of 2020.
  private func resources(of id: ChunkID) -> SlurmSubmission.Resources? {
    folder.plan[id].map { chunk in
      SlurmSubmission.Resources(
        threads: max(1, min(chunk.threads, settings.maximumThreads)),
        memoryMegabytes: chunk.memoryBytes >> 20,
        minutes: max(10, Int(chunk.expectedSeconds * 4 / 60)))
    }
  }

  /// What the next job of a chunk may use; nil if it is not to be made again. Records the reason of
  /// one that ended without a word.
  private func resources(
    after last: SlurmSubmission, attempts: Int, of id: ChunkID
  ) -> SlurmSubmission.Resources? {
    var status = folder.status(of: id)
    let isOfLastJob = status?.job?.hasPrefix("\(last.job)_") ?? false
    var resources = last.resources
    if !isOfLastJob || status?.status == .cancelled {
      let end = slurm.end(of: last.job, task: task(of: id, in: last))
      guard end?.state.hasPrefix("CANCELLED") != true else { return nil }
      if end?.state == "TIMEOUT" { resources.minutes *= 2 }
      status = silentEnd(end, of: id, status)
      status.map { try? folder.record($0, of: id) }
    }
    guard let status, status.isTransient, attempts <= settings.retries else { return nil }
    if status.isShortOfMemory {
      // Slurm refuses jobs that no machine has the memory for. What was killed may have had enough.
      let limit = max(resources.memoryMegabytes, settings.maximumMegabytes ?? .max)
      resources.memoryMegabytes = min(limit, 2 * resources.memoryMegabytes)
    }
    return resources
  }

  private func task(of id: ChunkID, in submission: SlurmSubmission) -> Int? {
    submission.numbers.firstIndex(of: id.number).map { $0 + 1 }
  }

  /// The status of a chunk whose process could not record one.
  private func silentEnd(
    _ end: Slurm.End?, of id: ChunkID, _ earlier: ChunkStatus?
  ) -> ChunkStatus? {
    guard let chunk = folder.plan[id] else { return nil }
    var status =
      earlier
      ?? ChunkStatus(fingerprint: chunk.fingerprint, status: .failed, node: end?.node ?? "")
    (status.status, status.isTransient) = (.failed, true)
    status.attempts += earlier?.status == .cancelled ? 0 : 1
    let signal = end?.exitCode.split(separator: ":").last.flatMap { Int32($0) } ?? 0
    status.isShortOfMemory = end?.state == "OUT_OF_MEMORY" || signal == SIGKILL
    let state = end.map { " (\($0.state), exit code \($0.exitCode))" } ?? ""
    let place = end.map { $0.node.isEmpty ? "" : " on \($0.node)" } ?? ""
    status.error =
      switch end?.state {
      case "OUT_OF_MEMORY": "The job\(place) was killed because its memory ran out."
      case "TIMEOUT": "The job\(place) was killed because its time ran out."
      case "NODE_FAIL": "The machine\(place) failed."
      default: "The job\(place) ended without a result\(state)."
      }
    return status
  }

  // MARK: - Submission

  /// Chunks in one array. Limit: Slurm's default `MaxArraySize` is 1001.
  private static let maximumArray = 1000

  private func submit(
    _ open: [ChunkID: SlurmSubmission.Resources], of stage: ChunkStage
  ) throws {
    var order = (files.submissions().last?.order ?? 0) + 1
    var jobs: [String] = []
    let groups = Dictionary(grouping: open.keys) { open[$0] }
    for (resources, ids) in groups.sorted(by: { $0.value.count > $1.value.count }) {
      guard let resources else { continue }
      let numbers = ids.map(\.number).sorted()
      for start in stride(from: 0, to: numbers.count, by: Self.maximumArray) {
        let part = Array(numbers[start..<min(start + Self.maximumArray, numbers.count)])
        let job = try submit(part, of: stage, resources)
        try files.write(
          SlurmSubmission(
            job: job, stage: stage.name, numbers: part, resources: resources, order: order))
        jobs.append(job)
        order += 1
      }
    }
    try submitFollowUp(after: jobs)
    // From here on the jobs continue without this process.
    logger.info(
      "Submitted \(open.count) of \(stage.chunks.count) chunks of \(stage.name) to Slurm.")
  }

  private func submit(
    _ numbers: [Int], of stage: ChunkStage, _ resources: SlurmSubmission.Resources
  ) throws -> String {
    // The array counts from 1; the script has the number of each chunk.
    let script = """
      #!/bin/sh
      set -- \(numbers.map(String.init).joined(separator: " "))
      shift $((SLURM_ARRAY_TASK_ID - 1))
      exec \(quoted(settings.program)) chunk \(quoted(folder.url.path)) \(stage.name) "$1" --quiet

      """
    return try slurm.submit(
      script,
      [
        "--job-name=\(jobName(stage.name))", "--array=1-\(numbers.count)", "--requeue",
        "--cpus-per-task=\(resources.threads)", "--mem=\(resources.memoryMegabytes)M",
        "--time=\(resources.minutes)", "--signal=B:TERM@30", "--open-mode=append",
        "--output=\(folder.logFolder.path)/slurm-\(stage.name)-%A_%a.log",
      ] + settings.options)
  }

  /// Submits the job that does what is next once `jobs` have ended in any way.
  func submitFollowUp(after jobs: [String]) throws {
    let script = """
      #!/bin/sh
      exec \(quoted(settings.program)) join \(quoted(folder.url.path)) --slurm --quiet

      """
    _ = try slurm.submit(
      script,
      [
        "--job-name=\(followUpName)", "--requeue", "--cpus-per-task=1", "--mem=1000M",
        "--time=60", "--dependency=afterany:\(jobs.joined(separator: ":"))", "--open-mode=append",
        "--output=\(folder.logFolder.path)/slurm-join.log",
      ] + settings.options)
  }

  private func quoted(_ text: String) -> String {
    "'" + text.replacingOccurrences(of: "'", with: "'\\''") + "'"
  }
}
