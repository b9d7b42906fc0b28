import Foundation
import SharedCommands

/// How far a plan is, from the files in its folder.
struct PlanProgress: Equatable, Sendable {
  /// The stage that is being made; nil if all are done.
  var stage: String?
  /// Of this stage.
  var chunks = 0
  var done = 0
  var running = 0
  var failed = 0
  /// Share of the expected work of all stages that is done, 0…1.
  var fraction = 0.0
  /// Estimated time left in seconds; nil before the first chunk is done.
  var remaining: Double?

  /// `known` are chunks that were done earlier: they are not looked at again. `running` are those
  /// in jobs that run.
  init(_ folder: PlanFolder, known: inout [ChunkID: ChunkStatus], running active: Set<ChunkID>) {
    if folder.isComplete {
      fraction = 1
      for id in folder.plan.results { known[id] = folder.doneStatus(of: id) }
      return
    }
    var (work, finished, expected, measured) = (0.0, 0.0, 0.0, 0.0)
    for stage in folder.plan.stages {
      var counts = (done: 0, failed: 0)
      for (id, chunk) in zip(stage.ids, stage.chunks) {
        work += chunk.expectedSeconds
        if let status = known[id] ?? folder.doneStatus(of: id) {
          known[id] = status
          counts.done += 1
          finished += chunk.expectedSeconds
          (expected, measured) = (expected + chunk.expectedSeconds, measured + status.seconds)
        } else if active.contains(id) {
          finished += chunk.expectedSeconds * (folder.progress(of: id)?.fraction ?? 0)
        } else if folder.status(of: id)?.status == .failed {
          counts.failed += 1
        }
      }
      let isDone = counts.done == stage.chunks.count
      if self.stage == nil, !isDone {
        (self.stage, chunks, done, failed) = (
          stage.name, stage.chunks.count, counts.done, counts.failed
        )
        running = stage.ids.count(where: active.contains)
      }
    }
    fraction = work > 0 ? finished / work : 1
    if expected > 0, !active.isEmpty {
      remaining = (work - finished) * measured / expected / Double(active.count)
    }
  }

  /// `views: 12 of 50 done, 8 running, 1 failed`.
  var text: String {
    guard let stage else { return "all chunks are done" }
    return "\(stage): \(done) of \(chunks) done, \(running) running"
      + (failed > 0 ? ", \(failed) failed" : "")
  }

  /// The progress and a note as a line of a terminal.
  func bar(width: Int, _ note: String) -> String {
    let left = remaining.map { "  \(RunProgress.duration($0)) left" } ?? ""
    let bar = RunProgress(fraction: fraction).bar(width: 200)
    return String("\(bar)  \(text)\(left)  \(note)".prefix(max(0, width - 1)))
  }
}
