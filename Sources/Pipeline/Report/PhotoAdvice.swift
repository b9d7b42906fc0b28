import Foundation
import SceneModel

/// What would help, from the figures of the photos: gaps between photos that match, blur, exposure,
/// and parts of the object that the model lacks.
struct PhotoAdvice {
  struct Options {
    /// The largest share of blurred photos that is nothing to speak of. Chosen.
    var blurredShare = 0.1
    /// A photo with less of its detail than this is blurred. Chosen: half the pixels would do.
    var minimumSharpness = 0.5
    /// The largest difference in exposure from the median that is nothing to speak of, in exposure
    /// values. Chosen: the compensation was measured on rendered sets up to two.
    var exposureRange = 1.0
    /// The smallest share of the object's outline that a whole model fills. Measured: 0.96 and more
    /// on 10 complete sets, 0.30 on one whose object stereo does not find.
    var outlineShare = 0.85
    /// The largest number of groups that are spoken of. Chosen.
    var maximumGroups = 4
    /// Fewer matches may occur by chance; as in the reasons of photos that are not registered.
    /// Chosen.
    var chanceMatches = 8
  }

  var options = Options()

  /// The advice on a run.
  func run(_ report: RunReport) -> [Advice] {
    let bridges = bridges(report)
    // Photos that are not joined are reason enough for missing parts.
    let texture = bridges.isEmpty ? texture(report) : nil
    return bridges + [blur(report), exposure(report), texture].compactMap(\.self)
  }

  // MARK: - Gaps between photos

  /// One for each group of photos that are not joined with the rest, and one for all single ones.
  private func bridges(_ report: RunReport) -> [Advice] {
    guard let gaps = MatchGaps(report, minimumSharpness: options.minimumSharpness) else {
      return []
    }
    let groups = gaps.groups.filter { $0.count > 1 || gaps.link($0).map(isReal) == true }
    let loners = gaps.groups.filter { $0.count == 1 && gaps.link($0).map(isReal) != true }
    return groups.prefix(options.maximumGroups).map { bridge($0, gaps) }
      + [self.loners(loners.map { gaps.names[$0[0]] })].compactMap(\.self)
  }

  private func isReal(_ link: MatchGaps.Link) -> Bool { link.matches >= options.chanceMatches }

  private func bridge(_ group: [Int], _ gaps: MatchGaps) -> Advice {
    let members = group.map { gaps.names[$0] }
    let subject =
      members.count == 1
      ? "\(members[0]) could not be joined with the rest"
      : "\(members.count) photos (\(members.list(3))) could not be joined with the rest"
    let unless =
      members.count == 1
      ? "If it shows something else, remove it." : "If they show something else, remove them."
    if let link = gaps.link(group), isReal(link) {
      let ends = [gaps.names[link.first], gaps.names[link.second]]
      return Advice(
        kind: .bridge,
        sentence: "\(subject). \(ends[0]) and \(ends[1]) look most alike, but not enough: take "
          + "three or more photos from places between these two, a small step apart. "
          + unless,
        photos: ends)
    }
    let ends = gaps.neighbors(of: group).map { gaps.names[$0] }
    return Advice(
      kind: .bridge,
      sentence: "\(subject): no photo shows the same. Take photos on the way from \(ends[0]) to "
        + "\(ends[1]), each of which shows most of what the one before shows. " + unless,
      photos: ends)
  }

  /// On photos that match no other.
  private func loners(_ names: [String]) -> Advice? {
    guard !names.isEmpty else { return nil }
    let isOne = names.count == 1
    return Advice(
      kind: .photos,
      sentence:
        "\(names.list(3)) \(isOne ? "matches" : "match") no other photo. If the object is in "
        + "\(isOne ? "it" : "them"), take more photos from nearby places, a small step apart; "
        + "otherwise remove \(isOne ? "it" : "them").",
      photos: names)
  }

  // MARK: - Quality of photos

  private func texture(_ report: RunReport) -> Advice? {
    guard let share = report.surface?.outlineShare, share < options.outlineShare else { return nil }
    let hasGivenMasks = report.photos.contains { $0.maskShare != nil && $0.maskAgreement == nil }
    let cause =
      hasGivenMasks
      ? "the masks don't fit the photos, or parts of the object are plain, shiny or transparent."
      : "parts of the object are missing, most likely because they are plain, shiny or transparent."
    return Advice(
      kind: .texture,
      sentence: "The model fills only \(Int((share * 100).rounded())) % of the object's outline in "
        + "the photos: \(cause) Use soft light from all sides, and dust or mark plain parts if you "
        + "may.")
  }

  private func blur(_ report: RunReport) -> Advice? {
    let names = report.photos.filter {
      $0.fault == .blurred || ($0.sharpness ?? 1) < options.minimumSharpness
    }.map(\.name)
    guard Double(names.count) > options.blurredShare * Double(report.photos.count) else {
      return nil
    }
    return Advice(
      kind: .blur,
      sentence: "\(names.count) of \(report.photos.count) photos are blurred (\(names.list(3))). "
        + "Hold the camera still for each photo, tap the object to focus, and use more light or a "
        + "tripod.",
      photos: names)
  }

  private func exposure(_ report: RunReport) -> Advice? {
    let photos = report.photos.filter { $0.exposure != nil }
    guard let median = photos.compactMap(\.exposure).upperMedian else { return nil }
    let others = photos.filter { abs(($0.exposure ?? median) - median) > options.exposureRange }
    let farthest = others.map { abs(($0.exposure ?? median) - median) }.max()
    guard let farthest else { return nil }
    let names = others.map(\.name)
    let factor = (pow(2, farthest) * 10).rounded() / 10
    return Advice(
      kind: .exposure,
      sentence:
        "\(names.list(3)) \(names.count == 1 ? "is" : "are") up to \(factor) times brighter "
        + "or darker than the other photos. Lock the exposure before the first photo: on a phone, "
        + "hold a finger on the object on the screen until the lock appears.",
      photos: names)
  }
}
