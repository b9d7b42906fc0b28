#if canImport(Pipeline)
  import ArgumentParser
  import Foundation
  import Kernels
  import Pipeline
  import RealityFoundation

  /// Makes a dense cloud from photos whose cameras are known.
  struct Densify: ParsableCommand {
    static let configuration = CommandConfiguration(
      commandName: "densify",
      abstract: "Make a dense cloud of points from photos whose cameras are known.",
      discussion: """
        Writes dense/points.ply, coloured points with normals in the frame of the cameras, unmoved, \
        and report.json into the folder <output>. Needs no GPU.

        EXAMPLES
          colmap mapper --database_path db --image_path photos --output_path sparse
          colmap model_converter --input_path sparse/0 --output_path sparse/0 \\
              --output_type TXT
          photogrammetry-cli densify photos/ sparse/0/ work/
              COLMAP's cameras; the photos needn't be undistorted.
          photogrammetry-cli align photos/ work/
          photogrammetry-cli densify photos/ work/ cloud/ -d full
              Our own cameras.
          photogrammetry-cli densify photos/ rig/ work/ --metric
              Cameras of a survey or a rig, in metres.

        CAMERAS
          The folder holds, in itself or in sparse/ or sparse/0/, either
          cameras.txt, images.txt and points3D.txt
              The text format of COLMAP, with cameras of the models
              SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL and OPENCV. For
              others, free the photos from distortion with 'colmap
              image_undistorter'. points3D.txt may be missing or empty: then
              points are triangulated, and no pose changes.
          or cameras.json (in itself)
              [{"name": "IMG_1.jpg", "K": [[f, 0, cx], [0, f, cy], [0, 0, 1]],
                "R": [[…], […], […]], "t": […], "width": 4000, "height": 3000}]
              where x_camera = R x_world + t, with x right, y down, z forward;
              width and height may be left out; they are then the photo's.
          Cameras are given to photos by file name. One that is for another
          size of the same shape is scaled. Pixels count from the corner of the
          top left one, in the photo turned upright by its EXIF orientation, as
          'align' writes them. Where the size tells that a camera is for the
          photo as it is stored, as COLMAP's are, it is turned; a photo that is
          stored upside down doesn't tell and must be turned first.

        DETAIL LEVELS (at most so many pixels of a photo are used)
          preview 0.08, reduced 0.18, medium 0.5, full 2, raw 4 megapixels

        JOBS
          --job 2/8 makes the patches of every eighth view, from the second on,
          in <output>/dense/views/, which is most of the work, and stops. Jobs
          may run one after the other or at once, also on several machines that
          share <output>; what all need they make between them. Then the same
          command without --job makes the cloud.

        Exit codes: 0 the cloud was written, 1 the photos give none with these cameras, 2 the \
        command line can't be carried out, 130 interrupted.
        """)

    @Argument(
      help: ArgumentHelp("The folder with the photos.", valueName: "input-folder"),
      completion: .directory)
    var inputFolder: String

    @Argument(
      help: ArgumentHelp("The folder with the cameras; see above.", valueName: "cameras-folder"),
      completion: .directory)
    var camerasFolder: String

    @Argument(
      help: ArgumentHelp("The folder for the results.", valueName: "output"), completion: .directory
    )
    var output: String

    @Option(name: .shortAndLong, help: "How dense the cloud is; see the table above.")
    var detail = DetailArgument.medium

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Pixels of a view at most, in the place of the level's.", visibility: .hidden))
    var viewPixels: Int?

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Leave a step out, to see what it is worth.", valueName: "step", visibility: .hidden))
    var without: [Ablation] = []

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Make the patches of a share of the views only.", valueName: "number/count"))
    var job: JobArgument?

    @Flag(
      name: .long,
      help: "The cameras' unit is the metre; the report then has points per cubic metre.")
    var metric = false

    @Flag(name: .long, help: "Ignore the photos' masks; see 'align --help' for these.")
    var noObjectMasking = false

    @OptionGroup var masking: MaskArguments

    @OptionGroup var arguments: RunArguments

    @OptionGroup var logging: LoggingOptions

    func validate() throws {
      if let viewPixels, viewPixels < 10_000 {
        throw ValidationError("--view-pixels must be 10000 or more.")
      }
    }

    mutating func run() throws {
      logging.bootstrap()
      let folder = try PhotoFolderArgument(inputFolder).url
      let cameras = try KnownCamerasArgument(camerasFolder, isMetric: metric).cameras
      let target = URL(fileURLWithPath: output, isDirectory: true)
      try ModelOutput.checkWritable(target)
      try arguments.checkOutputs()
      var configuration = PipelineConfiguration()
      configuration.checkpointDirectory = target
      configuration.isObjectMaskingEnabled = !noObjectMasking
      configuration.ingestion.maskFolder = try masking.folder
      if let threads = arguments.threads { configuration.threadCount = threads }
      without.forEach { $0.apply(to: &configuration.pointCloudGeneration) }
      let flag = CancellationFlag()
      let interrupts = InterruptHandler { flag.cancel() }
      let listener = PipelineListener(
        RunReporter(logging.style(json: false)), stages: Self.stages(cameras), tellsDetails: true)
      let pipeline = ReconstructionPipeline(
        .photosWithCameras(in: folder, cameras), configuration: configuration,
        checkpointAccess: job == nil ? .exclusive : .shared, flag: flag, onEvent: listener.take)
      let outcome = Result { try work(pipeline) }
      listener.finish()
      try arguments.writeReport(of: pipeline)
      if case .failure(let error) = outcome {
        guard interrupts.wasInterrupted else { throw error }
        throw CommandFailure(
          sentence: "Interrupted; no points were written.",
          exitCode: CommandFailure.interruptedCode)
      }
      let result = job == nil ? "dense/points.ply" : "dense/views"
      Terminal.shared.result(target.appendingPathComponent(result).relativePath)
    }
  }

  /// One of several jobs, as in "2/8".
  struct JobArgument: ExpressibleByArgument {
    let share: PointCloudGeneration.Share

    init?(argument: String) {
      let numbers = argument.split(separator: "/", omittingEmptySubsequences: false).map { Int($0) }
      guard numbers.count == 2, let number = numbers[0], let count = numbers[1], count >= 1,
        (1...count).contains(number)
      else { return nil }
      share = PointCloudGeneration.Share(index: number - 1, of: count)
    }
  }

  /// A step of the dense stage that can be left out.
  enum Ablation: String, CaseIterable, ExpressibleByArgument {
    case completion
    case expansionAcrossViews = "expansion-across-views"
    case normals
    case filter
    case coarseToFine = "coarse-to-fine"

    func apply(to options: inout PointCloudGeneration.Options) {
      switch self {
      case .completion: options.completes = false
      case .expansionAcrossViews: options.patches.expandsAcrossViews = false
      case .normals: options.patches.estimatesNormals = false
      case .coarseToFine: options.patches.levelCount = 1
      case .filter:
        options.filter.minimumAgreeingViews = 0
        options.filter.contradictionThreshold = 1e9
        options.filter.depthEdgePasses = 0
        options.filter.minimumIsland = 0
      }
    }
  }

  extension Densify {
    private func work(_ pipeline: ReconstructionPipeline) throws {
      let specification = specification()
      if let job {
        try pipeline.makePatches(job.share, for: specification)
      } else {
        _ = try pipeline.densify(for: specification)
      }
    }

    private func specification() -> DetailSpecification {
      var specification = DetailSpecification(detail.detail, custom: .init())
      if let viewPixels { specification.viewPixels = viewPixels }
      return specification
    }

    /// The stages with their usual shares of the time.
    private static func stages(_ cameras: KnownCameras) -> [PipelineListener.Stage] {
      // Points that came with the cameras need not be found.
      let search = cameras.reconstruction.points.isEmpty ? 0.3 : 0.01
      return [
        .init(.preProcessing, as: .preProcessing, share: 0.04),
        .init(.imageAlignment, as: .triangulation, share: search),
        .init(.pointCloudGeneration, as: .pointCloudGeneration, share: 0.96 - search),
      ]
    }
  }
#endif
