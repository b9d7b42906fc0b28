import Foundation
import SharedCommands

/// The state of all datasets of a batch, as text, CSV and JSON.
struct BatchSummary: Codable, Equatable {
  /// In the order of the folders.
  var datasets: [BatchEntry]

  /// Number of datasets with a status.
  func count(_ status: DatasetStatus) -> Int { datasets.count { $0.status == status } }

  /// The content of `batch.json`.
  func json() throws -> Data { try JSONEncoder.readable.encode(self) }

  /// The content of `batch.csv` (RFC 4180).
  var csv: String {
    let header = [
      "name", "status", "photos", "registered", "triangles", "seconds", "attempts", "error",
      "model",
    ]
    let rows = datasets.map { entry in
      [
        entry.name, entry.status.rawValue, "\(entry.photos)", text(entry.registered),
        text(entry.triangles), "\((entry.seconds * 10).rounded() / 10)", "\(entry.attempts)",
        entry.error ?? "", entry.model,
      ]
    }
    return ([header] + rows).map { $0.map(Self.quoted).joined(separator: ",") + "\r\n" }.joined()
  }

  /// A table, the causes of failures, and the totals.
  var lines: [String] {
    let header = ["name", "status", "photos", "registered", "triangles", "time", "attempts"]
    let rows = datasets.map { entry in
      [
        entry.name, entry.status.rawValue, "\(entry.photos)", text(entry.registered),
        text(entry.triangles), RunProgress.duration(entry.seconds), "\(entry.attempts)",
      ]
    }
    let failures = datasets.filter { $0.status == .failed }.map {
      "\($0.name): \($0.error ?? "unknown error")"
    }
    return Self.aligned([header] + rows) + failures + [total]
  }

  private var total: String {
    let counts = DatasetStatus.allCases.map { (status: $0, count: count($0)) }
      .filter { $0.count > 0 }.map { "\($0.count) \($0.status.rawValue)" }
    return "\(datasets.count) dataset\(datasets.count == 1 ? "" : "s"): "
      + counts.joined(separator: ", ") + "."
  }

  private func text(_ number: Int?) -> String { number.map { "\($0)" } ?? "" }

  /// Pads columns to a common width; the first two are left-aligned, the others right-aligned.
  private static func aligned(_ rows: [[String]]) -> [String] {
    let widths = rows[0].indices.map { column in rows.map { $0[column].count }.max() ?? 0 }
    return rows.map { row in
      let cells = zip(row, widths).enumerated().map { column, cell in
        let space = String(repeating: " ", count: cell.1 - cell.0.count)
        return column < 2 ? cell.0 + space : space + cell.0
      }
      return cells.joined(separator: "  ")
    }
  }

  private static func quoted(_ field: String) -> String {
    let isPlain = !field.unicodeScalars.contains { ["\"", ",", "\n", "\r"].contains($0) }
    return isPlain ? field : "\"" + field.replacingOccurrences(of: "\"", with: "\"\"") + "\""
  }
}
