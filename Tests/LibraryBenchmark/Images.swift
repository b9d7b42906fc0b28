import ArgumentParser
import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel

/// The result and the cost of the call with the least processor time of several.
private func least<Value>(
  of repetitions: Int, _ body: () throws -> Value
) throws -> (value: Value, cost: Cost) {
  var best = try Cost.measuring(body)
  for _ in 1..<max(1, repetitions) {
    let next = try Cost.measuring(body)
    if next.cost.cpuSeconds < best.cost.cpuSeconds { best = next }
  }
  return best
}

/// Finds features in two photos and matches them; writes x₁ y₁ x₂ y₂ of each match in pixels.
struct Features: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "features")

  @Argument(help: "A photo.") var first: String
  @Argument(help: "Another photo.") var second: String
  @Argument(help: "Matches.") var output: String
  @Option(help: "Maximum number of features per photo.") var maximum = 8000
  @Option(help: "Calls; the fastest counts.") var repetitions = 3

  struct Result: Codable {
    var counts: [Int]
    var matches: Int
    var detection: Cost
    var matching: Cost
  }

  func run() throws {
    let control = KernelControl(threadCount: 1)
    let images = try [first, second].map {
      try ImageCodec.decode(ImageCodec.contents(of: URL(fileURLWithPath: $0)))
    }
    var detection = FeatureDetection()
    (detection.maximumFeatures, detection.sufficientFeatures) = (maximum, maximum)
    let (sets, detected) = try least(of: repetitions) {
      try images.map { try detection.features(in: $0, control) }
    }
    let (matches, matched) = try least(of: repetitions) {
      try DescriptorMatching().matches(sets[0], sets[1], control)
    }
    let places = matches.flatMap {
      [sets[0].positions[Int($0.first)], sets[1].positions[Int($0.second)]]
    }
    try NumberFile.write(places.flatMap { [Double($0.x), Double($0.y)] }, to: output)
    try printJSON(
      Result(
        counts: sets.map(\.count), matches: matches.count, detection: detected, matching: matched))
  }
}

/// Decodes an image file and encodes its pixels.
struct Codecs: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "codecs")

  @Argument(help: "An image file.") var image: String
  @Option(help: "Calls; the fastest counts.") var repetitions = 3

  struct Result: Codable {
    var width: Int
    var height: Int
    var decoding: Cost
    var pngEncoding: Cost
    var pngBytes: Int
    var jpegEncoding: Cost
    var jpegBytes: Int
  }

  func run() throws {
    let bytes = try ImageCodec.contents(of: URL(fileURLWithPath: image))
    let (image, decoding) = try least(of: repetitions) { try ImageCodec.decode(bytes) }
    let (png, pngEncoding) = try least(of: repetitions) { try ImageCodec.encodePNG(image) }
    let (jpeg, jpegEncoding) = try least(of: repetitions) {
      try ImageCodec.encodeJPEG(image, quality: 0.9)
    }
    try printJSON(
      Result(
        width: image.width, height: image.height, decoding: decoding, pngEncoding: pngEncoding,
        pngBytes: png.count, jpegEncoding: jpegEncoding, jpegBytes: jpeg.count))
  }
}

/// Parses the metadata of photos and prints it.
struct Metadata: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "metadata")

  @Argument(help: "Photos.") var photos: [String]

  struct Fields: Codable {
    var make: String?
    var model: String?
    var orientation: Int
    var focalLength: Double?
    var focalLengthIn35mmFilm: Double?
    var originalWidth: Int?
    var captureTime: String?
    var latitude: Double?
    var longitude: Double?
    var altitude: Double?
  }

  struct Result: Codable {
    var fields: [Fields]
    var cost: Cost
  }

  func run() throws {
    let contents = try photos.map { try ImageCodec.contents(of: URL(fileURLWithPath: $0)) }
    let (read, cost) = Cost.measuring { contents.map { PhotoMetadata($0) } }
    let fields = read.map {
      Fields(
        make: $0.make, model: $0.model, orientation: $0.sensorOrientation,
        focalLength: $0.focalLength, focalLengthIn35mmFilm: $0.focalLengthIn35mmFilm,
        originalWidth: $0.originalWidth, captureTime: $0.captureTime,
        latitude: $0.position?.latitudeDegrees, longitude: $0.position?.longitudeDegrees,
        altitude: $0.position?.altitude)
    }
    try printJSON(Result(fields: fields, cost: cost))
  }
}

/// Reads a mesh and writes it as PLY, GLB and USDZ, without images.
///
/// The texture coordinates are x and y of the vertices, scaled to the unit square.
struct Containers: ParsableCommand {
  static let configuration = CommandConfiguration(commandName: "containers")

  @Argument(help: "A mesh, PLY.") var mesh: String
  @Argument(help: "The folder for `mesh.ply`, `mesh.glb` and `mesh.usdz`.") var folder: String
  @Option(help: "Calls; the fastest counts.") var repetitions = 3

  func run() throws {
    let source = URL(fileURLWithPath: mesh)
    let (mesh, reading) = try least(of: repetitions) { try PLY.readMesh(source) }
    let textured = textured(mesh)
    let content = ModelContent(mesh: textured, textures: [], creator: "library-benchmark")
    let folder = URL(fileURLWithPath: folder)
    let (ply, plyWriting) = try least(of: repetitions) { PLY.encode(mesh) }
    let (glb, glbWriting) = try least(of: repetitions) {
      try GLBFile.encode(textured, materials: [], creator: "library-benchmark")
    }
    let (usdz, usdzWriting) = try least(of: repetitions) { try USDZPackage.encode(content) }
    for (name, bytes) in [("mesh.ply", ply), ("mesh.glb", glb), ("mesh.usdz", usdz)] {
      try Data(bytes).write(to: folder.appendingPathComponent(name))
    }
    try printJSON([
      "plyReading": reading, "plyWriting": plyWriting, "glbWriting": glbWriting,
      "usdzWriting": usdzWriting,
    ])
  }

  private func textured(_ mesh: Mesh) -> TexturedMesh {
    let bounds = mesh.bounds ?? (.zero, .zero)
    let size = pointwiseMax(bounds.max - bounds.min, SIMD3(repeating: 1e-9))
    return TexturedMesh(
      mesh: mesh,
      textureCoordinates: mesh.positions.map {
        let p = ($0 - bounds.min) / size
        return [p.x, p.y]
      },
      textureTriangles: mesh.triangles,
      atlases: [TextureAtlas(triangles: 0..<mesh.triangles.count, maps: [:])])
  }
}
