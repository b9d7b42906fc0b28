import Foundation
import Kernels
import SceneModel

/// Estimates the mask of the object in each photo by minimum cuts.
///
/// The evidence is that of the coarse reconstruction, of the colors of object and surroundings,
/// and, from the second round on, of the other photos: the visual hull of the previous round's
/// masks (after Campbell et al., "Automatic 3D object segmentation in multiple views using
/// volumetric graph-cuts", IVC 2010).
struct MaskEstimation: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Number of rounds of cuts, at least two. Chosen.
    var rounds = 2
    /// Log-odds of a pixel inside a region of surface points, away from its outline. Chosen.
    var coreEvidence: Float = 5
    /// The same near the outline, where the coarse reconstruction is inaccurate. Chosen.
    var rimEvidence: Float = 1.5
    /// Log-odds of a pixel without a surface point. Chosen.
    var emptyEvidence: Float = -1
    /// The same where the pixel is inside the visual hull. Chosen.
    var hullEvidence: Float = 1
    /// Log-odds of all pixels outside the visual hull are reduced by this. Chosen.
    var outsideEvidence: Float = 4
    /// Weight of the log-likelihood ratio of the colors, and its maximum magnitude: neighboring
    /// pixels are not independent. Chosen.
    var colorWeight: Float = 0.6
    var maximumColorRatio: Float = 6
    /// Share of the photo's own surroundings in the model of the surroundings' colors. Chosen.
    var localShare: Float = 0.5
    var cut = ImageCut()
    var hull = VisualHull.Options()

    init() {}
  }

  /// The masks, by view.
  struct Result: Sendable {
    var masks: [RasterImage]
    /// Intersection over union of each mask and the outline of the visual hull that the masks of
    /// the previous round have, 0…1.
    var agreement: [Double]
  }

  var options = Options()

  /// Returns the masks of the object that consists of `points`.
  func run(
    _ views: [MaskingView], points: [SIMD3<Float>], _ context: StageContext
  ) throws -> Result {
    var masks = views.map { view in view.labels.marking { $0 == PointLabel.object } }
    masks = try cut(
      views, masks, views.map { _ in nil }, context.part(from: 0, to: 0.4).control)
    var silhouettes: [RasterImage?] = []
    for round in 1..<max(2, options.rounds) {
      let share = 0.6 / Double(max(2, options.rounds) - 1)
      let start = 0.4 + Double(round - 1) * share
      let part = context.part(from: start, to: start + share)
      silhouettes = try context.notes.step("visualHull") {
        let hull = try VisualHull(
          of: views, masks: masks, around: points, options: options.hull,
          part.part(from: 0, to: 0.3).control)
        return try part.part(from: 0.3, to: 0.4).control.parallelMap(views.count) {
          try hull.silhouette(in: views[$0], KernelControl())
        }
      }
      masks = try cut(views, masks, silhouettes, part.part(from: 0.4, to: 1).control)
    }
    let agreement = zip(masks, silhouettes).map { mask, silhouette in
      silhouette.map { mask.intersectionOverUnion(with: $0) } ?? 0
    }
    return Result(masks: masks, agreement: agreement)
  }

  /// One round of cuts; `masks` are those of the previous round.
  private func cut(
    _ views: [MaskingView], _ masks: [RasterImage], _ silhouettes: [RasterImage?],
    _ control: KernelControl
  ) throws -> [RasterImage] {
    var (object, surroundings) = (ColorHistogram(), ColorHistogram())
    let local = try control.parallelMap(views.count) { index in
      var pair = (object: ColorHistogram(), surroundings: ColorHistogram())
      let (view, mask) = (views[index], masks[index])
      pair.object.add(view.photo.image) { mask.pixels[$0] != 0 }
      pair.surroundings.add(view.photo.image) { mask.pixels[$0] == 0 }
      return pair
    }
    for pair in local {
      object.add(pair.object, total: pair.object.total)
      surroundings.add(pair.surroundings, total: pair.surroundings.total)
    }
    let objectColors = object.probabilities()
    return try control.parallelMap(views.count) { [surroundings] index in
      var colors = ColorHistogram()
      colors.add(surroundings, total: 1 - options.localShare)
      colors.add(local[index].surroundings, total: options.localShare)
      let ratios = zip(objectColors, colors.probabilities()).map { object, other in
        options.colorWeight
          * min(options.maximumColorRatio, max(-options.maximumColorRatio, log(object / other)))
      }
      let odds = logOdds(views[index], ratios, silhouettes[index])
      return try options.cut.mask(of: views[index].photo.image, logOdds: odds, KernelControl())
    }
  }

  /// The evidence at each pixel of a view; `ratios` is that of the colors, by bin.
  private func logOdds(
    _ view: MaskingView, _ ratios: [Float], _ silhouette: RasterImage?
  ) -> [Float] {
    let (labels, isCore, isNear) = (view.labels.pixels, view.isCore.pixels, view.isNear.pixels)
    let (image, hull) = (view.photo.image, silhouette?.pixels)
    return (0..<view.photo.pixelCount).map { pixel in
      let isInHull = hull.map { $0[pixel] != 0 }
      guard isNear[pixel] != 0 || isInHull == true else { return -options.cut.certainty }
      let strength = isCore[pixel] != 0 ? options.coreEvidence : options.rimEvidence
      let geometry =
        switch labels[pixel] {
        case PointLabel.object: strength
        case PointLabel.surroundings: -strength
        default: isInHull == true ? options.hullEvidence : options.emptyEvidence
        }
      return geometry + ratios[ColorHistogram.bin(image, 3 * pixel)]
        - (isInHull == false ? options.outsideEvidence : 0)
    }
  }
}

extension RasterImage {
  /// The number of pixels that both gray images mark, relative to those that at least one marks; 1
  /// if there are none.
  func intersectionOverUnion(with other: RasterImage) -> Double {
    var (both, any) = (0, 0)
    for (a, b) in zip(pixels, other.pixels) {
      if a != 0 && b != 0 { both += 1 }
      if a != 0 || b != 0 { any += 1 }
    }
    return any == 0 ? 1 : Double(both) / Double(any)
  }
}
