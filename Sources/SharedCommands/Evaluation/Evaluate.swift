import ArgumentParser
import Evaluation
import Foundation
import SceneModel

/// Compares a result with ground truth.
package struct Evaluate: ParsableCommand {
  package static let configuration = CommandConfiguration(
    commandName: "evaluate",
    abstract: "Compare a result with a reference: poses, points and surface.",
    discussion: """
      The result is a checkpoint directory (its sparse/, dense/points.ply and mesh/surface.ply are \
      compared), a folder with COLMAP's cameras.txt, images.txt and points3D.txt, or a PLY file.

      The reference is a folder with cameras.json (a list of name, K, R and t) and mesh.ply, \
      directly in it or in gt/, or a folder with COLMAP's text files. Photos are matched by name. \
      A result with poses is first aligned to the reference's frame by a similarity transform; a \
      PLY file is compared without alignment.

      If the reference has cameras, recall counts only the surface that at least three of them \
      see. A point cloud is scored twice, unchanged and after voxel downsampling, because \
      densely sampled easy regions would otherwise dominate its scores.

      EXAMPLE
        photogrammetry-cli evaluate work/ --reference boot/ --floor z=0.004

      Lengths are in units of the reference.
      """)

  @Argument(
    help: ArgumentHelp("A checkpoint directory, COLMAP text folder or PLY file."),
    completion: .file())
  package var result: String

  @Option(
    name: .long, help: ArgumentHelp("The folder with the ground truth.", valueName: "folder"),
    completion: .directory)
  package var reference: String

  @Option(
    name: .long, parsing: .upToNextOption,
    help: ArgumentHelp(
      "Distance thresholds of precision, recall and F-score. (default: 0.0005 0.001 0.002)",
      valueName: "length"))
  package var threshold: [Double] = []

  @Option(
    name: .long,
    help: ArgumentHelp("Number of samples on the result's surface.", valueName: "count"))
  package var samples = 1_000_000

  @Option(
    name: .long,
    help: ArgumentHelp("Voxel size of the downsampling; 0 for none.", valueName: "length"))
  package var voxel = 0.0005

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Ignore everything below this height, such as a table and what touches it.",
      valueName: "axis=height"))
  package var floor: Floor?

  @Flag(name: .long, help: "Print one JSON object instead of a table.")
  package var json = false

  @OptionGroup package var logging: LoggingOptions

  package init() {}

  package func validate() throws {
    if threshold.contains(where: { !($0 > 0) || !$0.isFinite }) {
      throw ValidationError("Each --threshold must be a length above 0.")
    }
    if !(1...100_000_000).contains(samples) {
      throw ValidationError("--samples must be from 1 to 100000000.")
    }
    if !(voxel >= 0) || !voxel.isFinite {
      throw ValidationError("--voxel must be a length, or 0 for no downsampling.")
    }
  }

  package mutating func run() throws {
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
        "\(self.result) can't be compared with \(self.reference). For poses, name a result with "
          + "sparse/ and a reference with cameras.json; for surfaces, a PLY file and a reference "
          + "with mesh.ply.")
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
  /// Parses `z=0.004`.
  public init?(argument: String) {
    let parts = argument.split(separator: "=", maxSplits: 1, omittingEmptySubsequences: false)
    guard parts.count == 2, let axis = ["x", "y", "z"].firstIndex(of: parts[0].lowercased()),
      let height = Double(parts[1]), height.isFinite
    else { return nil }
    self.init(axis: axis, height: height)
  }
}
