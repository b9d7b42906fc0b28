import ArgumentParser
import Pipeline

/// A part of a run, such as `cameras`, or `features:2/8` for the second of eight blocks.
enum PartArgument: Equatable, ExpressibleByArgument {
  case part(RunPart)
  /// What an ordinary run makes of the parts before, but for tiles, which others make meanwhile.
  case model

  init?(argument: String) {
    let words = argument.split(separator: ":", omittingEmptySubsequences: false).map(String.init)
    let block = words.count == 2 ? JobArgument(argument: words[1])?.share : nil
    let parts: [String: RunPart] = [
      "photos": .photos, "candidates": .candidates, "morePairs": .morePairs,
      "cameras": .cameras, "tileBase": .tileBase, "surface": .surface, "tileIndex": .tileIndex,
    ]
    if argument == "model" {
      self = .model
    } else if words.count == 1, let part = parts[words[0]] {
      self = .part(part)
    } else if let block {
      guard let part = Self.part(words[0], Block(index: block.index, of: block.count)) else {
        return nil
      }
      self = .part(part)
    } else {
      return nil
    }
  }

  private static func part(_ name: String, _ block: Block) -> RunPart? {
    switch name {
    case "inspections": .inspections(block)
    case "features": .features(block)
    case "pairs": .pairs(block)
    case "matches": .matches(block)
    case "moreMatches": .moreMatches(block)
    default:
      DensePart(rawValue: name).map { .views($0, block) }
        ?? TilePart(rawValue: name).map { .tiles($0, block) }
    }
  }
}
