import Foundation
import Kernels
import SceneModel

/// Measures how far the picture moves from frame to frame.
///
/// The distance of a frame from an earlier one, the anchor, is the mean displacement of the
/// features that match: not the median, because on a turntable most of the picture may stand still.
/// Features that seem to move within the noise of their positions stand still, and distances to an
/// anchor don't add up that noise as those from frame to frame would.
struct FrameMotion {
  struct Options: Hashable, Sendable {
    /// Distance from the anchor, as a share of the diagonal, beyond which the frame becomes the
    /// anchor. Chosen: a quarter of the step of `FrameSelection`.
    var anchorDistance = 0.0075
    /// Number of anchors in the video at least. Chosen: where only a part of the picture moves, its
    /// features stop matching long before the mean displacement is large.
    var minimumAnchors = 80
    /// Matches below which frames have nothing in common, as after a cut. Chosen.
    var minimumMatches = 12
    /// The distance of such frames as a share of the diagonal. Chosen: the step of
    /// `FrameSelection`.
    var unknownDistance = 0.03
    /// Displacement as a share of the diagonal up to which a feature stands still. Chosen: three
    /// times the noise of positions, half a pixel of 734.
    var noise = 0.002
    /// Share of the matches with the largest displacements that may be wrong. Chosen.
    var wrongShare = 0.05

    init() {}
  }

  let options: Options
  /// Diagonal of the frames in pixels.
  private let diagonal: Double
  /// Seconds after which the frame becomes the anchor.
  private let maximumAge: Double
  private var anchor: (features: FeatureSet, seconds: Double, position: Double)?
  private var position = 0.0

  init(width: Int, height: Int, duration: Double, _ options: Options = Options()) {
    self.options = options
    diagonal = Double(width * width + height * height).squareRoot()
    maximumAge = duration / Double(options.minimumAnchors)
  }

  /// The position of the next frame along the path; never less than that of the frame before.
  mutating func advance(_ features: FeatureSet, at seconds: Double) throws -> Double {
    guard let anchor else {
      self.anchor = (features, seconds, 0)
      return 0
    }
    let distance = try distance(anchor.features, features)
    position = max(position, anchor.position + distance)
    if distance >= options.anchorDistance || seconds - anchor.seconds >= maximumAge {
      self.anchor = (features, seconds, position)
    }
    return position
  }

  private func distance(_ first: FeatureSet, _ second: FeatureSet) throws -> Double {
    let matches = try DescriptorMatching().matches(first, second, KernelControl())
    guard matches.count >= options.minimumMatches else { return options.unknownDistance }
    let lengths = matches.map { match in
      Double((first.positions[Int(match.first)] - second.positions[Int(match.second)]).length)
    }.sorted()
    let kept = lengths.prefix(Int((Double(lengths.count) * (1 - options.wrongShare)).rounded(.up)))
    let moved = kept.drop { $0 <= options.noise * diagonal }
    return moved.reduce(0, +) / Double(kept.count) / diagonal
  }
}
