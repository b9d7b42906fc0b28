import Foundation
import ReportPages
import SharedCommands

extension BatchSummary {
  /// The page that lists the reports in `folder`.
  func index(in folder: URL) -> IndexPage {
    func existing(_ name: String) -> String? {
      let path = folder.appendingPathComponent(name, isDirectory: false).path
      return FileManager.default.fileExists(atPath: path) ? name : nil
    }
    return IndexPage(
      title: folder.lastPathComponent, summary: lines.last ?? "",
      rows: datasets.map { entry in
        IndexPage.Row(
          name: entry.name, report: existing(entry.name + BatchCompanion.report.suffix),
          picture: existing(entry.name + BatchCompanion.preview.suffix),
          isGood: [.done, .skipped].contains(entry.status), result: entry.status.rawValue,
          sentence: entry.error,
          photos: entry.registered.map { "\($0) of \(entry.photos)" } ?? "\(entry.photos)",
          triangles: entry.triangles.map(ModelFacts.grouped) ?? "",
          time: RunProgress.duration(entry.seconds))
      })
  }
}
