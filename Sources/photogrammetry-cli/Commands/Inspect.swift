#if canImport(Pipeline)
  import ArgumentParser
  import Foundation
  import Kernels
  import Pipeline
  import SceneModel

  /// Tells what a run would use.
  struct Inspect: ParsableCommand {
    static let configuration = CommandConfiguration(
      commandName: "inspect",
      abstract: "Tell which photos of a folder would be used, which not, and why.",
      discussion: """
        Reads and checks every file as 'reconstruct' does, masks too, without reconstructing. With --overlap it \
        also tells which photos show the same parts and which stand alone, so that you know what to \
        photograph again; that takes as long as the first half of the alignment.

        EXAMPLES
          photogrammetry-cli inspect photos/
          photogrammetry-cli inspect photos/ --overlap

        Exit codes: 0 there are enough photos, 1 there are too few, 2 the folder can't be read.
        """)

    @Argument(
      help: ArgumentHelp("The folder with the photos.", valueName: "input-folder"),
      completion: .directory)
    var inputFolder: String

    @Flag(name: .long, help: "Tell which photos overlap with which.")
    var overlap = false

    @Flag(name: .long, help: "Print one JSON object instead of a table.")
    var json = false

    @Option(name: .long, help: ArgumentHelp("Threads to read with.", valueName: "count"))
    var threads: Int?

    @OptionGroup var masking: MaskArguments

    @OptionGroup var logging: LoggingOptions

    static let neededPhotos = PipelineError.minimumPhotos

    mutating func run() throws {
      logging.bootstrap()
      let folder = try PhotoFolderArgument(inputFolder).url
      let count = threads ?? ProcessInfo.processInfo.activeProcessorCount
      let reporter = ProgressBox(RunReporter(logging.style(json: false)))
      let control = KernelControl(threadCount: max(1, count)) { reporter.update($0) }
      let configuration = PipelineConfiguration()
      var options = configuration.ingestion
      options.maskFolder = try masking.folder
      let ingested = try PhotoIngestion(options).run(folder: folder, StageContext(control: control))
      var report = InspectionReport(ingested)
      if overlap, ingested.photos.count >= 2 {
        let images = ImageStore(
          photos: ingested.photos, byteBudget: configuration.imageMemory,
          processingPixels: ingested.processingPixels)
        let survey = try OverlapSurvey().run(
          photos: ingested.photos, cameras: ingested.cameras, images: images,
          StageContext(control: control))
        report.overlap = OverlapReport(survey, ingested.photos)
      }
      reporter.finish()
      if json {
        Terminal.shared.result(try report.encoded())
      } else {
        report.lines.forEach(Terminal.shared.result)
      }
      guard ingested.photos.count >= Self.neededPhotos else {
        throw CommandFailure.run(
          "\(ingested.photos.count) usable photos are too few for a reconstruction. Take 20 or "
            + "more all around the object, each overlapping its neighbors by 70 %.")
      }
    }
  }

  /// A reporter that any thread may use.
  private final class ProgressBox: Sendable {
    private let reporter: Locked<RunReporter>

    init(_ reporter: RunReporter) { self.reporter = Locked(reporter) }

    func update(_ fraction: Double) {
      reporter.withLock {
        $0.update(RunProgress(fraction: fraction, stage: .preProcessing, remaining: nil))
      }
    }

    func finish() { reporter.withLock { $0.finish() } }
  }

  /// What `inspect` prints.
  struct InspectionReport: Encodable {
    struct Used: Encodable {
      var name: String
      var width: Int
      var height: Int
      var camera: Int
      /// Pixels.
      var focalLength: Double
      var calibration: Camera.Calibration
      var hasPosition: Bool
      /// Share of the photo that its mask leaves; nil without one.
      var maskCoverage: Double?
    }

    struct Refused: Encodable {
      var name: String
      var fault: RefusedPhoto.Fault
      var reason: String
    }

    var used: [Used]
    var refused: [Refused]
    var refusedMasks: [RefusedMask]
    var cameras: Int
    var isDownsampled: Bool
    var overlap: OverlapReport?

    init(_ ingested: IngestedPhotos) {
      used = ingested.photos.map { photo in
        let camera = ingested.cameras[photo.camera.index]
        return Used(
          name: photo.name, width: photo.width, height: photo.height, camera: photo.camera.index,
          focalLength: camera.focalLength.x, calibration: camera.calibration,
          hasPosition: photo.position != nil, maskCoverage: photo.mask?.coverage)
      }
      refused = ingested.refused.map { Refused(name: $0.name, fault: $0.fault, reason: $0.reason) }
      refusedMasks = ingested.refusedMasks
      cameras = ingested.cameras.count
      isDownsampled = ingested.isDownsampled
    }

    func encoded() throws -> String {
      let encoder = JSONEncoder()
      encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
      return String(decoding: try encoder.encode(self), as: UTF8.self)
    }

    /// A table of the used photos, the sentences about the others and a summary.
    var lines: [String] {
      let width = used.map(\.name.count).max() ?? 0
      var lines = used.map { photo in
        let name = photo.name.padding(toLength: width, withPad: " ", startingAt: 0)
        let focal = "focal length \(Int(photo.focalLength.rounded())) px (\(photo.calibration))"
        let place = photo.hasPosition ? "  GPS" : ""
        let mask = photo.maskCoverage.map { "  mask \(max(1, Int(($0 * 100).rounded()))) %" } ?? ""
        return
          "\(name)  \(photo.width) x \(photo.height)  camera \(photo.camera + 1)  "
          + "\(focal)\(place)\(mask)"
      }
      lines += refused.map(\.reason) + refusedMasks.map(\.reason)
      lines.append(
        "\(used.count) photos of \(cameras) camera\(cameras == 1 ? "" : "s") would be used, "
          + "\(refused.count) file\(refused.count == 1 ? "" : "s") not.")
      let masks = used.count { $0.maskCoverage != nil }
      if masks > 0 { lines.append("\(masks) of \(used.count) photos have a mask.") }
      if isDownsampled {
        lines.append("Photos would be used at a lower resolution to fit the memory.")
      }
      return lines + (overlap?.lines ?? [])
    }
  }
#endif
