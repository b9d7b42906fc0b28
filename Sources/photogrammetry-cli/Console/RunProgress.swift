import Foundation

/// How far a run is.
struct RunProgress: Equatable {
  /// 0…1.
  var fraction = 0.0
  var stage: RunStage?
  /// Seconds.
  var remaining: Double?
}

/// The stages of a run by the names that people read and programs get.
enum RunStage: String, CaseIterable, Codable {
  case preProcessing, imageAlignment, pointCloudGeneration, meshGeneration, textureMapping
  case optimization
  /// Finding points with cameras that are known.
  case triangulation

  /// For people.
  var title: String {
    switch self {
    case .preProcessing: "reading photos"
    case .imageAlignment: "aligning photos"
    case .pointCloudGeneration: "generating points"
    case .meshGeneration: "generating mesh"
    case .textureMapping: "mapping texture"
    case .optimization: "writing model"
    case .triangulation: "triangulating points"
    }
  }
}

extension RunProgress {
  /// `[#####...............]  25 %  aligning photos  1:05 left`, at most `width` columns.
  func bar(width: Int) -> String {
    let cells = 24
    let filled = min(cells, max(0, Int((fraction * Double(cells)).rounded(.down))))
    let bar =
      "[" + String(repeating: "#", count: filled)
      + String(repeating: ".", count: cells - filled) + "]"
    return String("\(bar) \(text)".prefix(max(0, width - 1)))
  }

  /// ` 25 %  aligning photos  1:05 left`.
  var text: String {
    let percent = "\(Int((min(1, max(0, fraction)) * 100).rounded(.down)))"
    var text = String(repeating: " ", count: 3 - percent.count) + "\(percent) %"
    if let stage { text += "  \(stage.title)" }
    if let remaining { text += "  \(Self.duration(remaining)) left" }
    return text
  }

  /// `0:07`, `12:34` or `1:02:03`.
  static func duration(_ seconds: Double) -> String {
    let total = Int(min(max(0, seconds), 359_999).rounded(.up))
    func two(_ value: Int) -> String { value < 10 ? "0\(value)" : "\(value)" }
    let (hours, minutes) = (total / 3600, total / 60 % 60)
    return hours > 0
      ? "\(hours):\(two(minutes)):\(two(total % 60))" : "\(minutes):\(two(total % 60))"
  }
}
