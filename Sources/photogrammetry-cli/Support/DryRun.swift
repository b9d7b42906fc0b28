#if canImport(Pipeline)
  import Formats
  import Foundation
  import Kernels
  import Pipeline
  import RealityFoundation

  /// Finds out what `reconstruct` would do, and how long it would take, without doing it.
  struct DryRun {
    let report: InspectionReport
    /// Where the model would go.
    let output: ModelOutput
    let specification: DetailSpecification
    /// Seconds, as a rule.
    let expectedSeconds: Double
    let threadCount: Int
    /// Bytes of memory that the run takes at most, as a rule, and that are free.
    let memory: (needed: Int, free: Int)
    /// Bytes of the disk that the model takes at most, and that are free.
    let space: (needed: Int, free: Int?)

    /// Reads and checks all photos and masks.
    init(_ arguments: Reconstruct, photos folder: URL, output: ModelOutput) throws {
      let count = arguments.engine.threads ?? ProcessInfo.processInfo.activeProcessorCount
      var options = PipelineConfiguration().ingestion
      options.maskFolder = try arguments.engine.masking.folder
      options.inspection.usesMasks = !arguments.noObjectMasking
      let ingested = try PhotoIngestion(options).run(
        folder: folder, StageContext(control: KernelControl(threadCount: count)))
      _ = try arguments.engine.knownDistances(photos: folder)
      report = InspectionReport(ingested)
      self.output = output
      specification = arguments.detail.budgets
      threadCount = count
      expectedSeconds =
        StageDurationModel(
          photos: PhotoTotals(ingested.photos), finest: specification, threadCount: count
        ).total
      memory = (
        BatchPlan.memory(for: arguments.detail.detail), Machine.current.availableMemoryBytes
      )
      let system = try? FileManager.default.attributesOfFileSystem(
        forPath: output.url.absoluteURL.deletingLastPathComponent().path)
      space = (
        specification.bytes(in: output.format), (system?[.systemFreeSize] as? NSNumber)?.intValue
      )
    }

    /// What stands in the way, in sentences with a remedy.
    var faults: [String] {
      var faults = Machine.current.shortfalls
      if report.used.count < Inspect.neededPhotos {
        faults.append(
          "\(report.used.count) usable photos are too few for a reconstruction. Take 20 or more all "
            + "around the object, each overlapping its neighbors by 70 %.")
      }
      if let free = space.free, free < space.needed {
        faults.append(
          "The disk has \(Self.megabytes(free)) free and the model may take "
            + "\(Self.megabytes(space.needed)). Free some space or choose another disk.")
      }
      return faults
    }

    /// For people.
    var lines: [String] {
      let texture = "\(specification.textureSide) x \(specification.textureSide)"
      return report.lines + [
        "\(output.url.relativePath) would be written: at most "
          + "\(specification.maximumTriangles) triangles and textures of \(texture).",
        "It would take about \(RunProgress.duration(expectedSeconds)) with \(threadCount) threads, "
          + "\(Self.megabytes(memory.needed)) of memory at most (\(Self.megabytes(memory.free)) are "
          + "free), and \(Self.megabytes(space.needed)) of the disk at most"
          + (space.free.map { " (\(Self.megabytes($0)) are free)." } ?? "."),
      ]
    }

    /// For programs: the files that would not be used, and the plan.
    var events: [RunEvent] {
      let refused = report.refused.map { RunEvent(event: "invalidSample", reason: $0.reason) }
      let masks = report.refusedMasks.map { RunEvent(event: "warning", message: $0.reason) }
      let plan = RunEvent(
        event: "plan", path: output.url.relativePath, photos: report.used.count,
        expectedSeconds: expectedSeconds, memoryBytes: memory.needed, diskBytes: space.needed)
      return refused + masks + [plan]
    }

    private static func megabytes(_ bytes: Int) -> String { "\(bytes / 1_000_000) MB" }
  }

  extension DetailSpecification {
    /// Bytes of a model at most: textures hardly compressed, and vertices with all they carry.
    fileprivate func bytes(in format: ModelFormat) -> Int {
      let mesh = maximumTriangles * 60
      guard format != .ply else { return mesh }
      return mesh + maximumAtlases * textureSide * textureSide * 3
        * maps.intersection(format.maps).count
    }
  }
#endif
