import Foundation

/// What a run cost, from its report.
package struct RunFigures: Codable, Hashable, Sendable {
  package var photos: Int
  /// Wall and processor time of all stages.
  package var seconds: Double
  package var cpuSeconds: Double
  package var secondsPerPhoto: Double
  package var peakMemoryBytes: Int

  /// Reads the content of a `report.json`; nil if it is none, or has no finished stage.
  package init?(report data: Data) {
    guard let report = try? JSONDecoder().decode(Report.self, from: data), !report.stages.isEmpty
    else { return nil }
    photos = report.photos.count
    seconds = report.stages.reduce(0) { $0 + $1.seconds }
    cpuSeconds = report.stages.reduce(0) { $0 + $1.cpuSeconds }
    secondsPerPhoto = seconds / Double(max(1, photos))
    peakMemoryBytes = report.stages.map(\.peakMemoryBytes).max() ?? 0
  }

  private struct Report: Decodable {
    struct Stage: Decodable {
      var seconds: Double
      var cpuSeconds: Double
      var peakMemoryBytes: Int
    }

    struct Photo: Decodable {}

    var stages: [Stage]
    var photos: [Photo]
  }
}
