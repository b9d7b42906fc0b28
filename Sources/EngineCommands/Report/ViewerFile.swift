import Foundation
import Pipeline
import SharedCommands

/// The page that shows a model, beside the model.
struct ViewerFile: Equatable, Sendable {
  let url: URL

  /// The page of the model `model`; throws a `CommandFailure` if it can't be written.
  init(of model: ModelOutput) throws {
    let path = model.url.relativePath as NSString
    url = URL(fileURLWithPath: "\(path.deletingPathExtension).html", isDirectory: false)
    try ModelOutput.checkWritable(url)
  }

  /// The page; nil if the run made no model.
  func content(_ material: ReportMaterial?, name: String) throws -> Data? {
    guard let material, let model = material.model else { return nil }
    var viewer = ReportMaterial()
    (viewer.model, viewer.pictures, viewer.isViewer) = (model, material.pictures, true)
    viewer.model?.maps = []
    viewer.facts = [["Triangles", "\(model.triangleCount)"]]
    return try ReportFile.page(title: name, report: Self.titleOnly(name), viewer)
  }

  /// The report of a page without a report: the page takes its title from it.
  static func titleOnly(_ name: String) throws -> Data {
    try JSONEncoder().encode(["run": ["name": name]])
  }
}
