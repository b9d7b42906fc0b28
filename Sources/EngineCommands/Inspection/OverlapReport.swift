import Foundation
import Pipeline
import SceneModel

/// Which photos overlap: what `inspect --overlap` prints.
struct OverlapReport: Encodable {
  struct Partner: Encodable {
    var name: String
    var matches: Int
  }

  struct Entry: Encodable {
    var name: String
    var features: Int
    /// Photos that share enough matches, in descending order of matches.
    var partners: [Partner]
    /// The photo with the most matches, if none has enough.
    var nearest: Partner?
  }

  var photos: [Entry]
  /// Names of photos that are connected by overlaps, the largest group first.
  var groups: [[String]]

  /// Maximum number of partners that a line lists. Chosen.
  private static let listedPartners = 4

  init(_ survey: OverlapSurvey.Result, _ photos: [Photo]) {
    func name(_ id: ID<Photo>) -> String { photos[id.index].name }
    func partner(_ partner: OverlapSurvey.Overlap.Partner) -> Partner {
      Partner(name: name(partner.photo), matches: partner.matches)
    }
    self.photos = survey.overlaps.map { overlap in
      Entry(
        name: name(overlap.photo), features: overlap.features,
        partners: overlap.partners.map(partner),
        nearest: overlap.partners.isEmpty ? overlap.nearest.map(partner) : nil)
    }
    groups = survey.groups.map { $0.map(name) }
  }

  /// A line per photo, and the consequences for a run.
  var lines: [String] {
    var lines = ["", "Overlap (matches):"]
    lines += photos.map(line)
    let connected = groups.filter { $0.count > 1 }
    let alone = groups.filter { $0.count == 1 }.flatMap { $0 }
    if connected.count == 1, alone.isEmpty {
      lines.append("All photos are connected.")
    }
    if connected.count > 1 {
      let sizes = connected.map { "\($0.count) (\($0[0]) to \($0[$0.count - 1]))" }
      lines.append(
        "The photos fall into groups of \(sizes.joined(separator: ", ")) without overlap; a run "
          + "uses the largest. Take photos in between.")
    }
    if !alone.isEmpty {
      lines.append(
        "\(alone.joined(separator: ", ")) overlap\(alone.count == 1 ? "s" : "") with no other "
          + "photo and would not be used.")
    }
    return lines
  }

  private func line(_ entry: Entry) -> String {
    let width = photos.map(\.name.count).max() ?? 0
    let name = entry.name.padding(toLength: width, withPad: " ", startingAt: 0)
    guard !entry.partners.isEmpty else {
      let nearest = entry.nearest.map { "; nearest is \($0.name) (\($0.matches))" } ?? ""
      return "\(name)  none\(nearest)"
    }
    let listed = entry.partners.prefix(Self.listedPartners).map { "\($0.name) (\($0.matches))" }
    let rest = entry.partners.count - listed.count
    return "\(name)  \(entry.partners.count): \(listed.joined(separator: ", "))"
      + (rest > 0 ? " and \(rest) more" : "")
  }
}
