import Evaluation
import Formats
import Foundation
import Kernels
import Pipeline
import SceneModel
import SharedCommands

extension ResultComparison {
  /// A page with the model, colored by the distance to the reference, and the scores. Throws a
  /// `CommandFailure` if there are no surfaces to compare.
  func page(_ report: EvaluationReport, name: String) throws -> Data {
    guard let loaded = result.model, let reference = reference?.model?.mesh else {
      throw CommandFailure.usage(
        "--page needs a result with a model and a reference with a surface.")
    }
    let options = comparison.options(threadCount: control.threadCount)
    let distances = SurfaceComparison(options).distances(
      of: loaded.mesh, report.alignment ?? .identity, to: reference)
    let unit = metersPerUnit.map { Float($0 * 1000) } ?? 1
    // The scale ends at twice the last threshold: what is beyond counts as wrong at all of them.
    let high = 2 * Float(options.thresholds.last ?? options.maximumDistance) * unit
    var material = ReportMaterial()
    material.isViewer = true
    var model = try PageModel(loaded, control)
    model.show(
      VertexFigures(
        .distance, "Distance to the reference", metersPerUnit == nil ? "units" : "mm",
        distances.map { $0 * unit }, high: high))
    material.model = model
    material.facts = EvaluationTable(report).rows.map { [$0.name, $0.value] }
    return try ReportFile.page(title: name, report: ViewerFile.titleOnly(name), material)
  }
}
