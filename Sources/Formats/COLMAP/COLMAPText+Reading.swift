import Foundation
import SceneModel

extension COLMAPText {
  /// Reads the model in `folder`; throws `FormatError`.
  ///
  /// Photos are numbered in the order of their ids in the file; their URLs are the file's names
  /// below `images`. Camera models: SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, and
  /// FULL_OPENCV if its additional parameters are 0; others throw `UnsupportedCameraModel`. Poses
  /// may follow each other without the empty keypoint lines, and points3D.txt may be missing.
  package static func read(
    _ folder: URL, images: URL = URL(fileURLWithPath: "/")
  ) throws -> Reconstruction {
    var reading = Reading()
    try reading.parse(folder, "cameras.txt") { try $0.addCamera($1) }
    var isPose = true
    try reading.parse(folder, "images.txt", keepsEmptyLines: true) { reading, line in
      if isPose, line.isEmpty { return }
      isPose = isPose || Reading.isPose(line)
      if isPose { try reading.addImage(line) } else { try reading.addKeypoints(line) }
      isPose.toggle()
    }
    let points = "points3D.txt"
    if FileManager.default.fileExists(atPath: folder.appendingPathComponent(points).path) {
      try reading.parse(folder, points) { try $0.addPoint($1) }
    }
    return reading.content.reconstruction(images: images)
  }
}

/// Parses lines and collects their content.
private struct Reading {
  struct Fault: Error { var reason: String }

  var content = COLMAPContent()

  /// Calls `line` for each line of a file, except comments, without the blanks around it: COLMAP
  /// ends its lists of keypoints with one. Adds file and line number to errors.
  mutating func parse(
    _ folder: URL, _ name: String, keepsEmptyLines: Bool = false,
    _ line: (inout Reading, Substring) throws -> Void
  ) throws {
    let url = folder.appendingPathComponent(name)
    let text = String(decoding: try contents(of: url), as: UTF8.self)
    for (number, content) in text.split(
      omittingEmptySubsequences: false, whereSeparator: \.isNewline
    ).enumerated() {
      let content = content.trimmingBlanks
      if content.first == "#" || (content.isEmpty && !keepsEmptyLines) { continue }
      do {
        try line(&self, content)
      } catch let error as UnsupportedCameraModel {
        throw UnsupportedCameraModel(path: url.path, model: error.model)
      } catch let fault as Fault {
        throw FormatError.malformed(
          path: url.path, reason: "line \(number + 1): \(fault.reason)")
      }
    }
  }

  mutating func addCamera(_ line: Substring) throws {
    let words = line.split(separator: " ")
    guard words.count >= 4, let id = Int(words[0]), let width = Int(words[2]),
      let height = Int(words[3]), width > 0, height > 0
    else { throw Fault(reason: "no camera with id, model, width and height") }
    let p = try numbers(words.dropFirst(4))
    let model = String(words[1])
    guard var camera = COLMAPContent.camera(model, p) else {
      guard COLMAPContent.unsupportedModels[model] == p.count else {
        throw Fault(reason: "camera model \(model) with \(p.count) parameters")
      }
      throw UnsupportedCameraModel(path: "", model: model)
    }
    guard camera.focalLength.x > 0, camera.focalLength.y > 0 else {
      throw Fault(reason: "the focal length is not positive")
    }
    (camera.width, camera.height) = (width, height)
    content.cameras.append((id, camera))
  }

  /// Whether a line where keypoints are expected is the next photo's pose: hand-written files with
  /// cameras only often omit the empty lines.
  static func isPose(_ line: Substring) -> Bool {
    let words = line.split(separator: " ", maxSplits: 9)
    guard words.count == 10 else { return false }
    let end = words[9].suffix(from: words[9].lastIndex(of: " ") ?? words[9].startIndex)
    return Double(end.drop { $0 == " " }) == nil && words[0..<9].allSatisfy { Double($0) != nil }
  }

  mutating func addImage(_ line: Substring) throws {
    let words = line.split(separator: " ", maxSplits: 9)
    guard words.count == 10, let id = Int(words[0]), let camera = Int(words[8]) else {
      throw Fault(reason: "no image with id, pose, camera and name")
    }
    let p = try numbers(words[1...7])
    content.images.append(
      COLMAPContent.Image(
        id: id, camera: camera, name: String(words[9]), pose: COLMAPContent.pose(p)))
  }

  mutating func addKeypoints(_ line: Substring) throws {
    let values = try numbers(line.split(separator: " "))
    guard values.count % 3 == 0 else {
      throw Fault(reason: "\(values.count) numbers are not a list of keypoints")
    }
    content.images[content.images.count - 1].pixels = stride(from: 0, to: values.count, by: 3).map {
      [values[$0], values[$0 + 1]]
    }
  }

  mutating func addPoint(_ line: Substring) throws {
    let words = line.split(separator: " ")
    guard words.count >= 8, words.count % 2 == 0, let id = Int(words[0]) else {
      throw Fault(reason: "no point with position, color, error and track")
    }
    let p = try numbers(words[1...7])
    let color = p[3..<6].map { UInt8(min(255, max(0, $0))) }
    var track: [(image: Int, keypoint: Int)] = []
    for index in stride(from: 8, to: words.count, by: 2) {
      guard let image = Int(words[index]), let keypoint = Int(words[index + 1]) else {
        throw Fault(reason: "'\(words[index]) \(words[index + 1])' is not an observation")
      }
      track.append((image, keypoint))
    }
    let point = ScenePoint(
      position: [p[0], p[1], p[2]], color: [color[0], color[1], color[2]], error: p[6])
    content.points.append(COLMAPContent.Point(id: id, point: point, track: track))
  }

  private func numbers(_ words: some Sequence<Substring>) throws -> [Double] {
    try words.map { word in
      guard let number = Double(word), number.isFinite else {
        throw Fault(reason: "'\(word)' is not a number")
      }
      return number
    }
  }
}

extension Substring {
  /// The text without spaces and tabs at its ends.
  fileprivate var trimmingBlanks: Substring {
    let rest = drop { $0 == " " || $0 == "\t" }
    guard let last = rest.lastIndex(where: { $0 != " " && $0 != "\t" }) else { return "" }
    return rest[...last]
  }
}
