import ArgumentParser
import Foundation
import Pipeline
import ReportPages
import SharedCommands

/// The file of `--report`: a page if it is named like one, else JSON.
struct ReportFile: Equatable, Sendable {
  let url: URL

  /// Throws a `CommandFailure` if the file can't be written.
  init(_ path: String) throws {
    url = URL(fileURLWithPath: path, isDirectory: false)
    try ModelOutput.checkWritable(url)
  }

  var isPage: Bool { ["html", "htm"].contains(url.pathExtension.lowercased()) }

  /// The content for the run of a command with the photos in `photos`.
  func content(
    _ report: RunReport, _ material: ReportMaterial?, photos: URL, output: URL?
  ) throws -> Data {
    var report = report
    report.run = RunDescription(report, photos: photos, output: output)
    let json = try report.encoded()
    guard isPage else { return json }
    return try Self.page(
      title: "\(report.run?.name ?? "Photos") – report", report: json,
      material ?? ReportMaterial())
  }

  /// A page with the 3-D library, if there is one.
  static func page(title: String, report: Data, _ material: ReportMaterial) throws -> Data {
    let library = ViewerLibrary.installed
    var material = material
    material.library = library.map { .init(name: $0.name, license: $0.license) }
    return ReportPage(
      title: title, report: report, material: try JSONEncoder().encode(material), library: library
    ).encoded
  }
}
