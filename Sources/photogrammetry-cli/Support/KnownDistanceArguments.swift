#if canImport(Pipeline)
  import ArgumentParser
  import Foundation
  import Pipeline

  /// `a.jpg,b.jpg=0.42`: two photos that were taken 0.42 m apart.
  struct CameraDistanceArgument: ExpressibleByArgument {
    let distance: KnownDistance

    init?(argument: String) {
      // Names of files may hold an equals sign; the length doesn't.
      guard let equals = argument.lastIndex(of: "="),
        let meters = Double(argument[argument.index(after: equals)...]), meters > 0,
        meters.isFinite
      else { return nil }
      let names = argument[..<equals].split(separator: ",", omittingEmptySubsequences: false)
        .map { $0.trimmingCharacters(in: .whitespaces) }
      guard names.count == 2, !names[0].isEmpty, !names[1].isEmpty, names[0] != names[1] else {
        return nil
      }
      distance = KnownDistance(from: .camera(names[0]), to: .camera(names[1]), meters: meters)
    }
  }

  /// A file with distances between points that are picked in photos.
  struct MeasurementFile {
    let distances: [KnownDistance]

    private struct Entry: Decodable {
      var meters: Double
      var from: [KnownDistance.Pick]
      var to: [KnownDistance.Pick]
    }

    /// Throws a `CommandFailure` that says what is wrong with the file.
    init(_ path: String) throws {
      func failure(_ reason: String) -> CommandFailure {
        .usage("\(path) can't be used: \(reason). 'reconstruct --help' shows how it should look.")
      }
      guard let data = FileManager.default.contents(atPath: path) else {
        throw failure("there is no such file, or it can't be read")
      }
      guard let entries = try? JSONDecoder().decode([Entry].self, from: data) else {
        throw failure("it is no list of distances with meters, from and to")
      }
      guard !entries.isEmpty else { throw failure("it holds no distance") }
      for entry in entries {
        guard entry.meters > 0, entry.meters.isFinite else {
          throw failure("a distance is not above 0")
        }
        for picks in [entry.from, entry.to] {
          guard Set(picks.map(\.photo)).count >= 2 else {
            throw failure("each point has to be picked in two photos or more")
          }
          guard picks.allSatisfy({ $0.x.isFinite && $0.y.isFinite }) else {
            throw failure("a pixel is no number")
          }
        }
      }
      distances = entries.map {
        KnownDistance(from: .point($0.from), to: .point($0.to), meters: $0.meters)
      }
    }
  }
#endif
