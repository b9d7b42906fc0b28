import ArgumentParser
import Evaluation
import Formats
import Foundation
import Kernels
import SceneModel
import SharedCommands

/// Compares a result with ground truth.
struct Evaluate: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "evaluate",
    abstract: "Score a result: poses, surface, points, held-out photos and outlines.",
    discussion: """
      The result is the checkpoint directory of a run, a folder with COLMAP's files (text or \
      binary), cameras as JSON, or as XML of Metashape and PhotoScan, or a model: \
      \(ModelFile.formats). With --model, the cameras are of the result, and the surface of a \
      model in the same frame.

      The reference is a folder with cameras.json (a list of name, K, R and t) and mesh.ply, \
      directly in it or in gt/, a folder with COLMAP's files, or a file with cameras or a surface. \
      Photos are matched by name.

      Poses: errors of centers and rotations, and the area under the recall curve (AUC) of \
      relative poses. Surfaces: precision (accuracy), recall (completeness) and F-score at several \
      distances, and their mean (Chamfer distance). If the reference has cameras, recall counts \
      only the surface that at least three of them see. Points are scored twice, unchanged and \
      after voxel downsampling, because densely sampled easy regions would otherwise dominate.

      Photos: PSNR and SSIM of the textured model where photos were held out: those in holdout/ \
      of the reference, or in --held-out; inside of NAME_mask.png, if it exists. Outlines: --masks \
      names a folder of masks drawn by hand, with which the model's outline is compared, or the \
      masks in the folder of the result.

      EXAMPLES
        photogrammetry-cli evaluate work/ --reference boot/ --floor z=0.004
            A run with --checkpoint-directory work/.
        photogrammetry-cli evaluate work/ --model model.usdz --reference boot/
            Its finished model, with its texture.
        photogrammetry-cli evaluate scan.glb --reference truth.ply --align icp
            Surfaces only, aligned with each other.
        photogrammetry-cli evaluate work/ --model model.usdz --masks drawn/
            The outline of a model.
        photogrammetry-cli evaluate work/ --reference boot/ --page errors.html
            A page with the distances on the surface.

      Lengths are in units of the reference; the table prints them in millimeters if --unit is \
      known.
      """)

  @Argument(
    help: ArgumentHelp(
      "A checkpoint directory, a folder or file with cameras, a model, or a folder of masks."),
    completion: .file())
  var result: String

  @Option(
    name: .long,
    help: ArgumentHelp("The ground truth: a folder or a file.", valueName: "path"),
    completion: .file())
  var reference: String?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "The model to score instead of that of the result, in the frame of its cameras.",
      valueName: "file"),
    completion: .file())
  var model: String?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Photos with cameras in the reference that were not among the input.", valueName: "folder"),
    completion: .directory)
  var heldOut: String?

  @Option(
    name: .long,
    help: ArgumentHelp("Masks of the object, white or opaque.", valueName: "folder"),
    completion: .directory)
  var masks: String?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "How the result is aligned with the reference: cameras, icp (by the surfaces), icp-rigid "
        + "(without scale) or none. (default: cameras if both have any, else none)"))
  var align: AlignmentMethod?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Unit of the reference: m, cm, mm, in, ft, or none if it is arbitrary."))
  var unit = LengthUnit.m

  @OptionGroup(title: "Comparison") var comparison: ComparisonArguments

  @OptionGroup(title: "Output") var output: EvaluationOutput

  @OptionGroup var threading: ThreadArguments

  @OptionGroup var logging: LoggingOptions

  mutating func run() throws {
    logging.bootstrap()
    let page = try output.page.map { path in
      let url = URL(fileURLWithPath: path, isDirectory: false)
      try ModelOutput.checkWritable(url)
      return url
    }
    var result = try EvaluationInput(result: result)
    if let model { try result.readModel(model) }
    let evaluation = ResultComparison(
      of: result, with: try reference.map { try EvaluationInput(reference: $0) },
      heldOutFolder: try heldOutFolder(), masks: try masks.map { try maskFolder($0) }, by: align,
      metersPerUnit: unit.meters, comparison,
      KernelControl(threadCount: threading.threadCount))
    let report = try evaluation.report()
    guard !report.isEmpty else {
      throw CommandFailure.usage(
        "\(self.result) can't be compared with \(reference ?? "nothing"). For poses, name a "
          + "result and a reference with cameras; for surfaces, a result with a model and a "
          + "reference with mesh.ply; for outlines, --masks.")
    }
    if let page {
      try AtomicFile.write(
        try evaluation.page(report, name: URL(fileURLWithPath: self.result).lastPathComponent),
        to: page)
    }
    Terminal.shared.result(try output.text(report))
    if let page { Terminal.shared.result(page.relativePath) }
  }

  /// The folder of held-out photos, if there is one.
  private func heldOutFolder() throws -> URL? {
    if let heldOut { return try FolderArgument.url(heldOut, holding: "photos") }
    guard let reference else { return nil }
    let folder = URL(fileURLWithPath: reference).appendingPathComponent(
      "holdout", isDirectory: true)
    return folder.isExistingFolder ? folder : nil
  }

  private func maskFolder(_ path: String) throws -> MaskFolder {
    let folder = MaskFolder(try FolderArgument.url(path, holding: "masks"))
    guard !folder.isEmpty else {
      throw CommandFailure.usage("\(path) holds no masks. Name a folder of PNG or JPEG files.")
    }
    return folder
  }
}

extension AlignmentMethod: ExpressibleByArgument {}
