import Foundation

/// What `demo` prints at its end: what was made, and what to try next.
struct DemoGuide {
  let files: DemoFolder
  let photoCount: Int

  var lines: [String] {
    made + [""] + next
  }

  private var made: [String] {
    let rows = [
      (files.photos, "\(photoCount) rendered photos of a statue on a table"),
      (files.model, "the model: open it in Blender, usdview or AR Quick Look"),
      (files.picture, "a picture of the model from eight sides"),
    ]
    return ["", "What was made:"] + Self.table(rows)
  }

  private var next: [String] {
    let rows = [
      ("photogrammetry-cli inspect photos/", "which photos can be used"),
      ("photogrammetry-cli photos/ model.usdz --preview model.png", "the model and a picture"),
      ("photogrammetry-cli photos/ model.glb -d medium", "more detail, for browsers and games"),
      ("photogrammetry-cli --help", "all commands and options"),
    ]
    return [
      "Next, your own photos: take 20 to 200 sharp photos all around an object, each overlapping",
      "its neighbors by 70 % or more, and put them into a folder, here photos/. Then try",
    ] + Self.table(rows)
  }

  private static func table(_ rows: [(String, String)]) -> [String] {
    let width = rows.map(\.0.count).max() ?? 0
    return rows.map { "  \($0.padding(toLength: width, withPad: " ", startingAt: 0))  \($1)" }
  }
}
