import ArgumentParser
import Formats
import Foundation
import RealityKit

#if canImport(Pipeline)
  import Kernels
  import Pipeline
  import RealityFoundation

  /// How any run of our engine works and what it leaves behind.
  struct RunArguments: ParsableArguments {
    @Option(
      name: .long,
      help: ArgumentHelp(
        "Write what was done, stage by stage and photo by photo, as JSON.", valueName: "file.json"),
      completion: .file(extensions: ["json"]))
    var report: String?

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Threads to work with; the result is the same for any number. (default: all processors)",
        valueName: "count"))
    var threads: Int?

    func validate() throws {
      if let threads, threads < 1 || threads > 1024 {
        throw ValidationError("--threads must be from 1 to 1024.")
      }
    }

    /// Checks what can be checked before the work begins.
    func checkOutputs() throws {
      if let report { try ModelOutput.checkWritable(URL(fileURLWithPath: report)) }
    }

    /// Writes the report into the checkpoint directory, and where it was asked for besides.
    func writeReport(of pipeline: ReconstructionPipeline) throws {
      try pipeline.writeReport()
      if let report {
        try AtomicFile.write(try pipeline.report.encoded(), to: URL(fileURLWithPath: report))
      }
    }
  }

  /// A picture of the model.
  struct PreviewArguments: ParsableArguments {
    @Option(
      name: .long,
      help: ArgumentHelp(
        "Draw the model from eight sides into one picture.", valueName: "file.png"),
      completion: .file(extensions: ["png"]))
    var preview: String?

    /// The file to write; throws a `CommandFailure` where that can't be.
    func file() throws -> URL? {
      guard let preview else { return nil }
      guard (preview as NSString).pathExtension.lowercased() == "png" else {
        throw CommandFailure.usage(
          "The preview \(preview) would be a PNG picture. Name a .png file.")
      }
      let url = URL(fileURLWithPath: preview, isDirectory: false)
      try ModelOutput.checkWritable(url)
      return url
    }

    func configure(_ session: PhotogrammetrySession) throws {
      session.engineOptions.previewFile = try file()
    }
  }

  /// Where the photos' masks are.
  struct MaskArguments: ParsableArguments {
    @Option(
      name: .long,
      help: ArgumentHelp(
        "The folder with the photos' masks, if not masks/ in that of the photos.",
        valueName: "folder"), completion: .directory)
    var masks: String?

    /// Nil where none is named; throws where it isn't a folder that holds something.
    var folder: URL? {
      get throws { try masks.map { try PhotoFolderArgument($0, holding: "masks").url } }
    }
  }

  /// Looking before leaping.
  struct DryRunArguments: ParsableArguments {
    @Flag(
      name: .customLong("dry-run"),
      help: "Check photos, masks, output and machine, tell what would be done, and do nothing.")
    var isWished = false

    /// Tells what a run would do; throws where something stands in its way.
    func run(
      _ arguments: Reconstruct, photos: URL, output: ModelOutput, _ reporter: RunReporter
    ) throws {
      let plan = try DryRun(arguments, photos: photos, output: output)
      if reporter.style == .json {
        plan.events.forEach(reporter.event)
      } else {
        plan.lines.forEach(Terminal.shared.result)
      }
      guard plan.faults.isEmpty else {
        throw CommandFailure.run(plan.faults.joined(separator: " "))
      }
    }
  }

  /// What only our engine can do.
  struct EngineArguments: ParsableArguments {
    /// How the scale is told, as a section of help.
    static let scaleHelp = """
      SCALE
        Photos with GPS give it. Before GPS come depth maps that a phone wrote beside
        the photos (for IMG_1.HEIC IMG_1_depth.TIF; IMG_1_gravity.TXT tells what is
        up), and before these distances that you measured:
        --camera-distance IMG_1.jpg,IMG_5.jpg=0.42
            The two photos were taken 0.42 m apart (lens to lens).
        --measurements points.json
            Distances between points. Each point is picked in two or more photos
            taken from different sides, in pixels from the top left as a viewer
            shows the photo:
            [{"meters": 0.2,
              "from": [{"photo": "IMG_1.jpg", "x": 812, "y": 1440},
                       {"photo": "IMG_5.jpg", "x": 1022, "y": 1396}],
              "to":   [{"photo": "IMG_1.jpg", "x": 1730, "y": 1452},
                       {"photo": "IMG_5.jpg", "x": 1911, "y": 1377}]}]

      """

    /// What a model can be written as, as a section of help.
    static let outputHelp = """
      OUTPUT
        model.usdz  for AR Quick Look, usdview, Blender
        model.glb   glTF 2.0, for browsers, engines, Blender; has no displacement
        model.ply   the mesh with a normal and a colour a vertex; no textures
        model/      a folder: OBJ, MTL, USDA and textures

      """

    /// What masks are and where they are found, as a section of help.
    static let maskHelp = """
      MASKS
        A mask is black where its photo doesn't show the object. What is black plays
        no part: neither in aligning the photos, so that an object may turn before a
        camera that stands still, nor in the surface and its colours. For the photo
        IMG_1.jpg a mask is
            beside it: IMG_1_mask.png, IMG_1.mask.png or IMG_1.jpg.mask.png;
            in the folder masks/ beside it, or in that of --masks: one of these,
            IMG_1.png or IMG_1.jpg.png;
            or the alpha channel of a photo in PNG, TIFF or WebP.
        Masks of another size are scaled. Photos without a mask are used whole.
        Where masks leave too little to align the photos by, what is around helps,
        if the object stood still.

      """

    @OptionGroup var masking: MaskArguments

    @OptionGroup var runArguments: RunArguments

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Metres between the places that two photos were taken from; gives the scale. May be repeated.",
        valueName: "a.jpg,b.jpg=metres"))
    var cameraDistance: [CameraDistanceArgument] = []

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Distances measured on the object, between points picked in photos; see above.",
        valueName: "file.json"), completion: .file(extensions: ["json"]))
    var measurements: String?

    var report: String? { runArguments.report }
    var threads: Int? { runArguments.threads }

    func checkOutputs() throws { try runArguments.checkOutputs() }

    /// The distances that the scale comes from; throws where a file or a photo isn't there.
    func knownDistances(photos folder: URL) throws -> [KnownDistance] {
      var distances = cameraDistance.map(\.distance)
      if let measurements { distances += try MeasurementFile(measurements).distances }
      for name in distances.flatMap({ $0.from.photos + $0.to.photos }) {
        let file = folder.appendingPathComponent(name)
        guard FileManager.default.fileExists(atPath: file.path) else {
          throw CommandFailure.usage(
            "A known distance names the photo \(name), which is not in \(folder.relativePath).")
        }
      }
      return distances
    }

    func configure(_ session: PhotogrammetrySession, photos folder: URL) throws {
      if let threads { session.engineOptions.threadCount = threads }
      session.engineOptions.knownDistances = try knownDistances(photos: folder)
      session.engineOptions.additionalFileFormats = Set(engineModelFiles)
      session.engineOptions.maskFolder = try masking.folder
    }

    /// The run's report as JSON, where there is one.
    func reportData(of session: PhotogrammetrySession) throws -> Data? {
      try session.report?.encoded()
    }
  }

  /// Adds what the run counted: photos, those that have a place, triangles of the last model.
  func engineCounts(of session: PhotogrammetrySession, into event: inout RunEvent) {
    guard let report = session.report else { return }
    event.photos = report.photos.count
    event.registered = report.photos.count { $0.status == .registered }
    let textured = report.stages.last { $0.name == PipelineStage.textureMapping.rawValue }
    event.triangles = textured?.counts["triangles"].map { Int($0) }
  }

  /// Why this machine can't make models.
  var unsupportedMachine: CommandFailure {
    let machine = Machine.current
    return .run(
      machine.shortfalls.joined(separator: " "),
      mayPass: machine.totalMemoryBytes >= Machine.neededMemoryBytes)
  }

  /// Whether the cause of an error may be gone at another time.
  func mayPass(_ error: any Error) -> Bool {
    switch error {
    case let error as ProcessingError: [.outOfMemory, .checkpointUnusable].contains(error.code)
    case KernelError.outOfMemory, CheckpointError.inUse: true
    default: false
    }
  }

  /// The formats of model files that the engine writes.
  let engineModelFiles = ModelFormat.files

  /// Our session logs what it meets; saying it again would be noise.
  let sessionLogsItsOutputs = true

  func engineIntrinsics(of pose: PhotogrammetrySession.Pose) -> PosesFile.Intrinsics? {
    pose.intrinsics.map { k in
      PosesFile.Intrinsics(
        focalLength: [k.columns.0.x, k.columns.1.y],
        principalPoint: [k.columns.2.x, k.columns.2.y])
    }
  }
#else
  /// Apple's engine draws no pictures.
  struct PreviewArguments: ParsableArguments {
    func file() throws -> URL? { nil }
    func configure(_ session: PhotogrammetrySession) throws {}
  }

  /// Apple's engine doesn't tell beforehand.
  struct DryRunArguments: ParsableArguments {
    var isWished: Bool { false }

    func run(
      _ arguments: Reconstruct, photos: URL, output: ModelOutput, _ reporter: RunReporter
    ) throws {}
  }

  /// Apple's engine has no options beyond its configuration.
  struct EngineArguments: ParsableArguments {
    static let scaleHelp = ""
    static let outputHelp = """
      OUTPUT
        model.usdz  for AR Quick Look
        model/      a folder: OBJ, MTL, USDA and textures

      """
    static let maskHelp = ""

    var report: String? { nil }

    func checkOutputs() throws {}
    func configure(_ session: PhotogrammetrySession, photos folder: URL) throws {}
    func reportData(of session: PhotogrammetrySession) throws -> Data? { nil }
  }

  let engineModelFiles = [ModelFormat.usdz]

  let sessionLogsItsOutputs = false

  func engineIntrinsics(of pose: PhotogrammetrySession.Pose) -> PosesFile.Intrinsics? { nil }

  func engineCounts(of session: PhotogrammetrySession, into event: inout RunEvent) {}

  var unsupportedMachine: CommandFailure { .run("This machine can't make models.") }

  func mayPass(_ error: any Error) -> Bool { false }

  /// What the engine logs besides telling it as an output.
  let sessionOutputSource = "photogrammetry.session.output"
#endif
