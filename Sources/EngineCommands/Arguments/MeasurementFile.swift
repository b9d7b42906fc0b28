import Foundation
import Pipeline
import SharedCommands

/// The file of `--measurements`: distances between points that are marked in photos.
struct MeasurementFile {
  let distances: [KnownDistance]

  private struct Entry: Decodable {
    var meters: Double
    var from: [KnownDistance.Pick]
    var to: [KnownDistance.Pick]
  }

  /// Throws a `CommandFailure` that names the fault of the file.
  init(_ path: String) throws {
    func failure(_ reason: String) -> CommandFailure {
      .usage("\(path) can't be used: \(reason). See 'reconstruct --help' for the format.")
    }
    guard let data = FileManager.default.contents(atPath: path) else {
      throw failure("it does not exist or can't be read")
    }
    guard let entries = try? JSONDecoder().decode([Entry].self, from: data) else {
      throw failure("it is not a list of distances with meters, from and to")
    }
    guard !entries.isEmpty else { throw failure("it has no distances") }
    for entry in entries {
      guard KnownDistance.possibleMeters.contains(entry.meters) else {
        throw failure("a distance is not \(KnownDistance.possibleMetersText)")
      }
      for picks in [entry.from, entry.to] {
        guard Set(picks.map(\.photo)).count >= 2 else {
          throw failure("each point must be marked in two photos or more")
        }
        guard picks.allSatisfy({ $0.x.isFinite && $0.y.isFinite }) else {
          throw failure("a pixel coordinate is not a finite number")
        }
      }
    }
    distances = entries.map {
      KnownDistance(from: .point($0.from), to: .point($0.to), meters: $0.meters)
    }
  }
}
