import Kernels
import SceneModel

/// What is known about object and surroundings before the photos' coarse reconstruction.
struct MaskPrior: Sendable {
  /// A feature of the surroundings.
  struct Feature: Sendable {
    /// Pixels of the upright photo, origin at the top-left corner.
    var position: SIMD2<Float>
    /// SIFT scale σ in pixels.
    var scale: Float
  }

  /// What photos show between which the object was not moved, in the frame of the object.
  struct Placement: Sendable {
    var photos: Set<Int>
    var silhouettes: Silhouettes
    var points: LabeledCloud
  }

  /// If empty, the object is what stands out of a rigid scene.
  var placements: [Placement] = []
  /// The features of surroundings that move relative to the object, by photo ID.
  var features: [[Feature]] = []

  init() {}

  /// The features that a view graph assigned to the surroundings.
  init(_ graph: ViewGraph, features: [FeatureSet]) {
    self.features = zip(graph.surroundings, features).map { isSurroundings, set in
      isSurroundings.indices.filter { isSurroundings[$0] }.map {
        Feature(position: set.positions[$0], scale: set.scales[$0])
      }
    }
  }

  /// The object in a cloud of all photos.
  ///
  /// Each placement decides about the points that it has a point of its own near by, within
  /// `tolerance` footprints. Where a placement has none, its photos may show what is behind the
  /// object. The object is what one placement classifies as such; points that none observes belong
  /// to it if all silhouettes contain them, or if photos of two placements show them: only the
  /// object is at the same place in both.
  func object(
    in cloud: PointCloud, tolerance: Float, _ control: KernelControl
  ) throws -> LabeledCloud {
    var votes = [(object: Bool, surroundings: Bool, isInside: Bool)](
      repeating: (false, false, true), count: cloud.count)
    for placement in placements {
      let isInside = try placement.silhouettes.areInside(cloud.positions, control)
      let nearest = try NearestPoints(
        of: cloud.positions, in: placement.points.cloud.positions, control)
      for point in cloud.positions.indices {
        votes[point].isInside = votes[point].isInside && isInside[point]
        guard nearest.distances[point] <= tolerance * cloud.footprints[point] else { continue }
        if placement.points.isObject[Int(nearest.indices[point])] {
          votes[point].object = true
        } else {
          votes[point].surroundings = true
        }
      }
    }
    var result = LabeledCloud(
      cloud: cloud,
      isObject: votes.indices.map { point in
        let vote = votes[point]
        return vote.object
          || (!vote.surroundings && (vote.isInside || isShownAcrossPlacements(point, of: cloud)))
      },
      isRigid: false)
    result.partialSurroundings = try placements.map { placement in
      let around = placement.points.surroundings
      let nearest = try NearestPoints(
        of: around.positions, in: result.object.positions, control)
      let isApart = around.positions.indices.map {
        nearest.distances[$0] > tolerance * around.footprints[$0]
      }
      return (placement.photos, around.filtered(by: isApart))
    }
    return result
  }

  /// Whether two photos of each of at least two placements show a point.
  private func isShownAcrossPlacements(_ point: Int, of cloud: PointCloud) -> Bool {
    let photos = cloud.visiblePhotos(of: point)
    return placements.count { placement in
      photos.count { placement.photos.contains(Int($0)) } > 1
    } > 1
  }

  /// Draws the features that a photo shows into its labels. `full` is the photo's size; features
  /// are discs of `radius` scales, at most `maximumRadius` pixels.
  func drawFeatures(
    of photo: ID<Photo>, full: SIMD2<Float>, radius: Float, maximumRadius: Float,
    into labels: inout RasterImage
  ) {
    guard features.indices.contains(photo.index) else { return }
    let factor = SIMD2(Float(labels.width), Float(labels.height)) / full
    for feature in features[photo.index] {
      labels.fillDisc(
        at: feature.position * factor,
        radius: min(maximumRadius, radius * feature.scale * factor.x),
        with: PointLabel.surroundings)
    }
  }
}

extension RasterImage {
  /// Sets the pixels of a gray image whose centers are within `radius` of a position.
  fileprivate mutating func fillDisc(at center: SIMD2<Float>, radius: Float, with value: UInt8) {
    let low = center - radius
    let high = center + radius
    guard high.x >= 0, high.y >= 0, low.x < Float(width), low.y < Float(height) else { return }
    for y in max(0, Int(low.y))...min(height - 1, Int(high.y)) {
      for x in max(0, Int(low.x))...min(width - 1, Int(high.x)) {
        let offset = SIMD2(Float(x), Float(y)) + 0.5 - center
        if (offset * offset).sum() <= radius * radius { pixels[y * width + x] = value }
      }
    }
  }
}
