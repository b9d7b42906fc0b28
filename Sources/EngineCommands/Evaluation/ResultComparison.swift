import Evaluation
import Formats
import Foundation
import Kernels
import Pipeline
import SceneModel
import SharedCommands

/// A result that is compared with a reference, as far as both have what it takes.
struct ResultComparison {
  let result: EvaluationInput
  let reference: EvaluationInput?
  let masks: MaskFolder?
  /// Nil for the default.
  let method: AlignmentMethod?
  let metersPerUnit: Double?
  let comparison: ComparisonArguments
  let control: KernelControl
  /// The photos that were held out, and the cameras of the others.
  private let heldOut: [HeldOutPhoto]
  private let referenceCameras: [NamedCamera]

  init(
    of result: EvaluationInput, with reference: EvaluationInput?, heldOutFolder: URL?,
    masks: MaskFolder?, by method: AlignmentMethod?, metersPerUnit: Double?,
    _ comparison: ComparisonArguments, _ control: KernelControl
  ) {
    (self.result, self.reference, self.masks) = (result, reference, masks)
    (self.method, self.metersPerUnit) = (method, metersPerUnit)
    (self.comparison, self.control) = (comparison, control)
    let cameras = reference?.cameras ?? []
    let marked = cameras.filter(\.isHeldOut)
    let heldOut =
      heldOutFolder.map { HeldOutPhoto.photos(in: $0, marked.isEmpty ? cameras : marked) } ?? []
    let names = Set(heldOut.map(\.camera.name))
    self.heldOut = heldOut
    referenceCameras = cameras.filter { !$0.isHeldOut && !names.contains($0.name) }
  }

  /// All scores. Throws a `CommandFailure` if an input can't be read or aligned.
  func report() throws -> EvaluationReport {
    do {
      return try scores()
    } catch let error where !(error is CommandFailure) {
      throw CommandFailure.run(CommandFailure(error).sentence)
    }
  }

  private func scores() throws -> EvaluationReport {
    var report = EvaluationReport()
    report.metersPerUnit = metersPerUnit
    report.reprojection = result.reconstruction.flatMap {
      $0.points.isEmpty ? nil : ReprojectionStatistics($0)
    }
    report.run = result.report.flatMap { RunFigures(report: $0) }
    let alignment = try align(&report)
    try scoreSurfaces(alignment, &report)
    if let cloud = result.cloud {
      report.density = CloudDensity(
        cloud, sparse: result.reconstruction, alignment, reference: reference?.model?.mesh)
    }
    if let model = result.model, !heldOut.isEmpty {
      let shaded = try ShadedModel(model, alignment, control)
      if shaded.hasColor {
        report.heldOut = try PhotoComparison(control).run(shaded, heldOut)
      }
    }
    report.outline = try outline()
    return report
  }

  private func outline() throws -> OutlineScores? {
    guard let masks else { return nil }
    var options = OutlineComparison.Options()
    options.maximumWidth = comparison.outlineWidth
    let outlines = OutlineComparison(options, control)
    if let found = result.masks { return try outlines.run(found, masks) }
    guard let model = result.model else { return nil }
    return try outlines.run(try ShadedModel(model, .identity, control), result.cameras, masks)
  }

  /// The transform `referenceFromResult`.
  private func align(_ report: inout EvaluationReport) throws -> SimilarityTransform {
    var alignment = SimilarityTransform.identity
    let cameras = referenceCameras
    let hasCameras = !cameras.isEmpty && !result.cameras.isEmpty
    let method = method ?? (hasCameras ? .cameras : AlignmentMethod.none)
    if hasCameras {
      let (errors, found) = try PoseErrors.comparing(result.cameras, with: cameras)
      report.poses = errors
      if method != .none { alignment = found }
    } else if method == .cameras {
      throw CommandFailure.usage(
        "The result or the reference has no cameras. Align by the surfaces: --align icp.")
    }
    if [.icp, .icpRigid].contains(method) {
      alignment = try register(method, hasCameras ? alignment : nil)
    }
    (report.alignment, report.alignedBy) = (method == .none ? nil : alignment, method)
    return alignment
  }

  private func register(
    _ method: AlignmentMethod, _ initial: SimilarityTransform?
  ) throws -> SimilarityTransform {
    var options = SurfaceRegistration.Options()
    options.estimatesScale = method == .icp
    options.threadCount = control.threadCount
    let registration = SurfaceRegistration(options)
    guard let reference = reference?.model?.mesh else {
      throw CommandFailure.usage(
        "The reference has no surface to align with. Choose another --align.")
    }
    if let mesh = result.model?.mesh { return try registration.run(mesh, reference, from: initial) }
    if let cloud = result.cloud { return try registration.run(cloud, reference, from: initial) }
    throw CommandFailure.usage("The result has no surface to align. Choose another --align.")
  }

  private func scoreSurfaces(
    _ alignment: SimilarityTransform, _ report: inout EvaluationReport
  ) throws {
    guard let mesh = reference?.model?.mesh, result.model != nil || result.cloud != nil else {
      return
    }
    let comparison = SurfaceComparison(comparison.options(threadCount: control.threadCount))
    let truth = try comparison.reference(mesh, cameras: referenceCameras)
    if let mesh = result.model?.mesh {
      report.triangles = mesh.triangles.count
      report.mesh = try comparison.run(mesh, alignment, reference: truth)
    }
    if let cloud = result.cloud {
      report.cloud = try comparison.run(cloud, alignment, reference: truth)
      if self.comparison.voxel > 0 {
        report.averagedCloud = try comparison.run(
          cloud, alignment, reference: truth, voxel: self.comparison.voxel)
      }
    }
  }
}
