import Kernels
import SceneModel

/// Rotation averaging, and the relative rotations that it starts from.
extension GlobalMapping {
  /// The maximum rotation of a consistent triplet's loop, in radians.
  private var tripletLimit: Double { options.tripletErrorDegrees * .pi / 180 }

  /// The fraction of the triplets of pairs whose relative rotations compose to the identity.
  func consistentTripletShare(
    _ graph: ViewGraph, _ features: [FeatureSet], _ photos: PosedPhotos, _ context: StageContext
  ) throws -> Double {
    try relativeRotations(graph, features, photos, context)
      .tripletCounts(limit: tripletLimit).consistentShare
  }

  /// The relative rotations of the pairs; re-estimated for pairs that were verified without focal
  /// lengths.
  func relativeRotations(
    _ graph: ViewGraph, _ features: [FeatureSet], _ photos: PosedPhotos, _ context: StageContext
  ) throws -> RotationGraph {
    let pairs = graph.pairs.filter { $0.matches.count >= options.minimumMatches }
    let rotations = try context.control.parallelMap(pairs.count) { index -> Quaternion? in
      let pair = pairs[index]
      if pair.model != .fundamental, let known = pair.secondFromFirst { return known.rotation }
      return try calibratedRotation(pair, features, photos)
    }
    return RotationGraph(
      photoCount: graph.photoCount,
      pairs: zip(pairs, rotations).compactMap { pair, rotation in
        rotation.map {
          RelativeRotation(
            first: pair.pair.first.rawValue, second: pair.pair.second.rawValue, rotation: $0,
            weight: Double(pair.matches.count))
        }
      })
  }

  /// The rotation of the essential matrix estimated from the inliers of a fundamental matrix.
  private func calibratedRotation(
    _ pair: VerifiedPair, _ features: [FeatureSet], _ photos: PosedPhotos
  ) throws -> Quaternion? {
    let (first, second) = (pair.pair.first.index, pair.pair.second.index)
    let cameras = [first, second].map { photos.cameras[Int(photos.cameraOfPhoto[$0])] }
    let limits = cameras.map {
      options.relativeMaximumError * $0.longerSide / $0.focalLength.x
    }
    var estimation = TwoViewEstimation()
    estimation.maximumError = max(limits[0], limits[1])
    estimation.seed = UInt64(first) << 32 &+ UInt64(second)
    let geometry = try estimation.geometry(
      cameras[0].normalizedPositions(of: pair.matches, in: features[first], \.first),
      cameras[1].normalizedPositions(of: pair.matches, in: features[second], \.second),
      KernelControl())
    guard let geometry, geometry.inliers.count >= options.minimumMatches else { return nil }
    return geometry.secondFromFirst.rotation
  }

  /// `cameraFromWorld` rotations of the photos that are well constrained by the pairs, nil for the
  /// others; nil as a whole for fewer than three photos.
  func rotations(
    _ relative: RotationGraph, _ context: StageContext
  ) throws -> [Quaternion?]? {
    var graph = relative.consistent(
      relative.tripletCounts(limit: tripletLimit), minimumShare: options.tripletShare)
    for round in 1...max(1, options.rotationRounds) {
      let photos = graph.largestTwoConnectedPart()
      guard photos.count >= 3 else { return nil }
      let part = graph.restricted(to: photos)
      let averaged = try RotationAveraging(options.averaging).run(
        part.pairs.map {
          RelativeRotation(first: $0.first, second: $0.second, rotation: $0.rotation)
        },
        start: part.treeRotations(), control: context.control)
      let isConsistent = averaged.errors.map { $0 <= options.rotationErrorDegrees * .pi / 180 }
      if round == options.rotationRounds || !isConsistent.contains(false) {
        var rotations = [Quaternion?](repeating: nil, count: graph.photoCount)
        for (photo, rotation) in zip(photos, averaged.rotations) { rotations[photo] = rotation }
        return rotations
      }
      graph.pairs = zip(part.pairs, isConsistent).filter(\.1).map { pair, _ in
        var pair = pair
        (pair.first, pair.second) = (
          Int32(photos[Int(pair.first)]), Int32(photos[Int(pair.second)])
        )
        return pair
      }
    }
    return nil
  }
}
