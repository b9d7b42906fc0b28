import ArgumentParser
import Foundation
import Pipeline

/// `a.jpg,b.jpg=0.42`: the distance between the cameras of two photos, in meters.
struct CameraDistanceArgument: ExpressibleByArgument {
  let distance: KnownDistance

  init?(argument: String) {
    // File names may contain an equals sign; the length does not.
    guard let equals = argument.lastIndex(of: "="),
      let meters = Double(argument[argument.index(after: equals)...]),
      KnownDistance.possibleMeters.contains(meters)
    else { return nil }
    let names = argument[..<equals].split(separator: ",", omittingEmptySubsequences: false)
      .map { $0.trimmingCharacters(in: .whitespaces) }
    guard names.count == 2, !names[0].isEmpty, !names[1].isEmpty, names[0] != names[1] else {
      return nil
    }
    distance = KnownDistance(from: .camera(names[0]), to: .camera(names[1]), meters: meters)
  }
}
