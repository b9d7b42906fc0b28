import ArgumentParser
import Evaluation
import Foundation
import SceneModel

/// Compares a result with the truth.
struct Evaluate: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "evaluate",
    abstract: "Compare a result with a reference: poses, points and surface.",
    discussion: """
      The result is a checkpoint directory (its sparse/, dense/points.ply and mesh/surface.ply are \
      compared), a folder with COLMAP's cameras.txt, images.txt and points3D.txt, or a PLY file.

      The reference is a folder with cameras.json (a list of name, K, R and t) and mesh.ply, in \
      itself or in gt/, or a folder with COLMAP's text files. Photos are matched by name. A result \
      with poses is moved to the reference's frame first; a PLY file is taken as it is.

      With cameras, only what three of them see is asked for. A cloud is scored as it is and \
      after averaging, since one that repeats what is easy to see looks better than it is.

      EXAMPLE
        photogrammetry-cli evaluate work/ --reference boot/ --floor z=0.004

      Lengths are in units of the reference.
      """)

  @Argument(
    help: ArgumentHelp("A checkpoint directory, COLMAP text folder or PLY file."),
    completion: .file())
  var result: String

  @Option(
    name: .long, help: ArgumentHelp("What is taken for true.", valueName: "folder"),
    completion: .directory)
  var reference: String

  @Option(
    name: .long, parsing: .upToNextOption,
    help: ArgumentHelp(
      "Distances of precision, recall and F-score. (default: 0.0005 0.001 0.002)",
      valueName: "length"))
  var threshold: [Double] = []

  @Option(name: .long, help: ArgumentHelp("Samples on the result's surface.", valueName: "count"))
  var samples = 1_000_000

  @Option(
    name: .long,
    help: ArgumentHelp("Side of the voxels of averaging; 0 for none.", valueName: "length"))
  var voxel = 0.0005

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Leave out what is below: a table, and what touches it.", valueName: "axis=height"))
  var floor: Floor?

  @Flag(name: .long, help: "Print one JSON object instead of a table.")
  var json = false

  @OptionGroup var logging: LoggingOptions

  func validate() throws {
    if threshold.contains(where: { !($0 > 0) || !$0.isFinite }) {
      throw ValidationError("Thresholds are lengths above 0.")
    }
    if !(1...100_000_000).contains(samples) {
      throw ValidationError("--samples must be from 1 to 100000000.")
    }
    if !(voxel >= 0) || !voxel.isFinite {
      throw ValidationError("--voxel is a length, or 0 for none.")
    }
  }

  mutating func run() throws {
    logging.bootstrap()
    let result = try EvaluationInput.result(result)
    let reference = try EvaluationInput.reference(reference)
    var options = SurfaceComparison.Options()
    if !threshold.isEmpty { options.thresholds = threshold.sorted() }
    options.resultSamples = samples
    options.floor = floor
    options.threadCount = ProcessInfo.processInfo.activeProcessorCount
    let report = try compare(result, reference, SurfaceComparison(options))
    let text = try json ? Self.encoded(report) : report.table
    Terminal.shared.result(text)
  }

  private func compare(
    _ result: EvaluationInput, _ reference: EvaluationInput, _ comparison: SurfaceComparison
  ) throws -> EvaluationReport {
    var report = EvaluationReport()
    var alignment = SimilarityTransform.identity
    if let reconstruction = result.reconstruction {
      report.reprojection = ReprojectionStatistics(reconstruction)
      if !reference.cameras.isEmpty {
        let (errors, found) = try PoseErrors.comparing(
          NamedCamera.cameras(of: reconstruction), with: reference.cameras)
        (report.poses, report.alignment, alignment) = (errors, found, found)
      }
    }
    if let mesh = reference.mesh, result.mesh != nil || result.cloud != nil {
      let truth = try comparison.reference(mesh, cameras: reference.cameras)
      if let mesh = result.mesh {
        report.triangles = mesh.triangles.count
        report.mesh = try comparison.run(mesh, alignment, reference: truth)
      }
      if let cloud = result.cloud {
        report.cloud = try comparison.run(cloud, alignment, reference: truth)
        if voxel > 0 {
          report.averagedCloud = try comparison.run(
            cloud, alignment, reference: truth, voxel: voxel)
        }
      }
    }
    guard report.poses != nil || report.mesh != nil || report.cloud != nil else {
      throw CommandFailure.usage(
        "The result and the reference have nothing in common that could be compared: poses need "
          + "sparse/ and cameras.json, surfaces need a PLY file and mesh.ply.")
    }
    return report
  }

  private static func encoded(_ report: EvaluationReport) throws -> String {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys]
    return String(decoding: try encoder.encode(report), as: UTF8.self)
  }
}

extension Floor: ExpressibleByArgument {
  /// `z=0.004`
  public init?(argument: String) {
    let parts = argument.split(separator: "=", maxSplits: 1, omittingEmptySubsequences: false)
    guard parts.count == 2, let axis = ["x", "y", "z"].firstIndex(of: parts[0].lowercased()),
      let height = Double(parts[1]), height.isFinite
    else { return nil }
    self.init(axis: axis, height: height)
  }
}
