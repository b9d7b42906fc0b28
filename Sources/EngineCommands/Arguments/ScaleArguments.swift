import ArgumentParser
import Foundation
import Pipeline
import SharedCommands

/// Measured distances, which give the scale.
struct ScaleArguments: ParsableArguments {
  /// Where the scale comes from, as a section of help.
  static let help = """
    SCALE
      The scale comes from the first of these that is present: distances that you
      measured, given by the options below; depth maps that a phone wrote into
      HEIC photos or next to them (IMG_1_depth.TIF for IMG_1.HEIC; the vertical is
      in photos of iPhones, or in IMG_1_gravity.TXT); GPS positions of the photos.
      --camera-distance IMG_1.jpg,IMG_5.jpg=0.42
          The cameras of the two photos were 0.42 m apart (lens to lens).
      --measurements points.json
          Distances between points. Each point is marked in two or more photos
          taken from different sides, in pixels from the top left corner of the
          photo as a viewer shows it:
          [{"meters": 0.2,
            "from": [{"photo": "IMG_1.jpg", "x": 812, "y": 1440},
                     {"photo": "IMG_5.jpg", "x": 1022, "y": 1396}],
            "to":   [{"photo": "IMG_1.jpg", "x": 1730, "y": 1452},
                     {"photo": "IMG_5.jpg", "x": 1911, "y": 1377}]}]

    """

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Distance in meters between the cameras of two photos, to set the scale. May be repeated.",
      valueName: "a.jpg,b.jpg=meters"))
  var cameraDistance: [CameraDistanceArgument] = []

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Distances on the object, between points marked in photos; see above.",
      valueName: "file.json"), completion: .file(extensions: ["json"]))
  var measurements: String?

  /// All distances. Throws a `CommandFailure` if the file can't be used or a photo isn't in the
  /// folder `photos`.
  func knownDistances(photos folder: URL) throws -> [KnownDistance] {
    var distances = cameraDistance.map(\.distance)
    if let measurements { distances += try MeasurementFile(measurements).distances }
    for name in distances.flatMap({ $0.from.photos + $0.to.photos }) {
      let file = folder.appendingPathComponent(name)
      guard FileManager.default.fileExists(atPath: file.path) else {
        throw CommandFailure.usage(
          "A known distance names the photo \(name), which is not in \(folder.relativePath). Check "
            + "the file name.")
      }
    }
    return distances
  }
}
