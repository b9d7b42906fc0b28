import Foundation
import Kernels
import SceneModel

/// Tests visibility hypotheses between nearby photos by template matching.
struct VisibilityTest: Sendable {
  let map: SparseMap
  private let features: [FeatureSet]
  private let photos: [Photo]
  private let extraction: TemplateExtraction
  private let options: SceneAmbiguityCheck.Options
  /// The mean viewing direction of each track's point, a unit vector in the world frame.
  private let normals: [SIMD3<Double>]

  init(
    _ map: SparseMap, features: [FeatureSet], photos: [Photo], images: ImageStore,
    _ options: SceneAmbiguityCheck.Options
  ) {
    (self.map, self.features, self.photos) = (map, features, photos)
    self.options = options
    extraction = TemplateExtraction(
      photos: photos, images: images, workingPixels: options.workingPixels)
    normals = (0..<map.tracks.count).map { track in
      map.activeObservations(of: track).reduce(SIMD3<Double>.zero) { sum, index in
        guard let pose = map.photos.poses[Int(map.tracks.photos[index])] else { return sum }
        return sum + (pose.center - map.positions[track]).normalized
      }.normalized
    }
  }

  /// The observation as a template for other photos.
  private func reference(_ observation: Int) -> TrackReference {
    let (photo, track) = (
      Int(map.tracks.photos[observation]), Int(map.tracks.trackOfObservation[observation])
    )
    let side = Double(max(photos[photo].width, photos[photo].height))
    let scales = features[photo].scales
    let feature = Int(map.tracks.features[observation])
    let scale = scales.indices.contains(feature) ? Double(scales[feature]) : 0
    return TrackReference(
      photo: photo, pixel: map.tracks.pixels[observation],
      step: max(options.stepPerScale * scale, options.relativeStep * side, 1),
      point: map.positions[track], normal: normals[track])
  }

  // MARK: Hypotheses

  /// The points that each photo should show of its neighbors if the map is correct.
  func hypotheses(_ control: KernelControl) throws -> [VisibilityHypothesis] {
    try control.parallelMap(photos.count) { photo -> [VisibilityHypothesis] in
      guard let pose = map.photos.poses[photo] else { return [] }
      let seen = map.tracks.observationsOfPhoto[photo].map(Int.init).filter { map.isActive[$0] }
        .map { (map.tracks.trackOfObservation[$0], map.tracks.pixels[$0]) }
      let view = VisibilityPrediction(photo, at: pose, seen: seen, map, options)
      guard let depth = view.medianDepth else { return [] }
      return neighbors(of: photo, pose, within: options.relativeDistance * depth).map {
        view.hypothesis(about: $0, map, options, reference: reference)
      }
    }.flatMap { $0 }
  }

  /// The nearest photos with a similar viewing direction.
  private func neighbors(of photo: Int, _ pose: RigidTransform, within reach: Double) -> [Int] {
    func axis(_ pose: RigidTransform) -> SIMD3<Double> {
      pose.rotation.conjugate * SIMD3(0, 0, 1)
    }
    let (center, ownAxis) = (pose.center, axis(pose))
    let minimumCosine = cos(options.axisDegrees * .pi / 180)
    let near = map.registered.compactMap { other -> (distance: Double, photo: Int)? in
      guard other != photo, let otherPose = map.photos.poses[other] else { return nil }
      let distance = (otherPose.center - center).length
      return distance < reach && axis(otherPose).dot(ownAxis) > minimumCosine
        ? (distance, other) : nil
    }
    return near.sorted { ($0.distance, $0.photo) < ($1.distance, $1.photo) }
      .prefix(options.neighbors).map(\.photo)
  }

  // MARK: Evaluation

  /// The comparison by each hypothesis, in their order.
  func evaluate(
    _ hypotheses: [VisibilityHypothesis], _ control: KernelControl
  ) throws -> [SceneAmbiguityCheck.Comparison] {
    let points = hypotheses.flatMap(\.points)
    let templates = try extraction.templates(
      of: points.map(\.reference), control.part(from: 0, to: 0.4))
    var ofPhoto = [[Int]](repeating: [], count: photos.count)
    var first = 0
    for hypothesis in hypotheses {
      ofPhoto[hypothesis.photo] += first..<first + hypothesis.points.count
      first += hypothesis.points.count
    }
    let found = try control.part(from: 0.4, to: 1).parallelMap(photos.count) {
      [ofPhoto] photo in
      try correlations(ofPhoto[photo], points, templates, in: photo)
    }
    var best = points.map { _ -> Double? in nil }
    for (numbers, values) in zip(ofPhoto, found) {
      for (number, value) in zip(numbers, values) { best[number] = value }
    }
    first = 0
    return hypotheses.map { hypothesis in
      defer { first += hypothesis.points.count }
      return comparison(hypothesis, Array(best[first..<first + hypothesis.points.count]))
    }
  }

  /// The highest correlation of each of some points in a photo, searched from several starting
  /// positions around the expected one; nil for points without a template.
  private func correlations(
    _ numbers: [Int], _ points: [ExpectedPoint], _ templates: TemplateMatching.Templates,
    in photo: Int
  ) throws -> [Double?] {
    guard !numbers.isEmpty else { return [] }
    let (image, factor) = try extraction.image(photo)
    let isOnObject = try extraction.isOnObject(photo)
    // Masked-out areas may occlude the point or differ between photos.
    var best = numbers.map { number -> Double? in
      let (pixel, reach) = (
        points[number].pixel, options.templateReach * points[number].reference.step
      )
      let isShown = Self.corners.allSatisfy { isOnObject((pixel + reach * $0) * factor) }
      return templates.isValid[number] && isShown ? -1.0 : nil
    }
    var matching = TemplateMatching()
    matching.maximumShift =
      options.maximumShift * (numbers.map { points[$0].reference.step }.max() ?? 1) * factor.x
    for offsets in [Self.offsets.prefix(1), Self.offsets.dropFirst()] {
      let open = best.indices.filter { best[$0].map { $0 < options.presentCorrelation } ?? false }
      guard !open.isEmpty else { break }
      let starts = open.flatMap { index in offsets.map { (index: index, offset: $0) } }
      let searches = starts.map { start in
        let point = points[numbers[start.index]]
        return TemplateMatching.Search(
          template: numbers[start.index], step: point.reference.step, warp: point.warp * factor.x,
          expected: (point.pixel + start.offset * point.reference.step) * factor)
      }
      for (start, find) in zip(starts, try matching.matches(searches, of: templates, in: image)) {
        best[start.index] = max(best[start.index] ?? -1, find?.zncc ?? -1)
      }
    }
    return best
  }

  /// The corners of a square around its center, in halves of its side.
  private static let corners: [SIMD2<Double>] = [[-1, -1], [1, -1], [-1, 1], [1, 1]]

  /// Starting positions of the search, in template samples.
  private static let offsets: [SIMD2<Double>] = [
    [0, 0], [2, 0], [-2, 0], [0, 2], [0, -2], [2, 2], [-2, -2], [2, -2], [-2, 2],
  ]

  /// Counts the present and absent points of a hypothesis, given their correlations.
  private func comparison(
    _ hypothesis: VisibilityHypothesis, _ correlations: [Double?]
  ) -> SceneAmbiguityCheck.Comparison {
    var comparison = SceneAmbiguityCheck.Comparison(
      pair: PhotoPair(ID(hypothesis.other), ID(hypothesis.photo)))
    var grid = PresenceGrid(photos[hypothesis.photo], cells: options.cells)
    var absentPixels: [SIMD2<Double>] = []
    for (point, correlation) in zip(hypothesis.points, correlations) {
      guard let correlation else { continue }
      if correlation >= options.presentCorrelation {
        comparison.present.append(point.track)
        grid.countPresent(point.pixel)
      } else if correlation < options.absentCorrelation {
        comparison.absent.append(point.track)
        grid.countAbsent(point.pixel)
        absentPixels.append(point.pixel)
      }
    }
    hypothesis.confirmedPixels.forEach { grid.countPresent($0) }
    comparison.contradictingCells = grid.contradictingCells(minimum: options.cellPoints)
    comparison.contradicting = zip(comparison.absent, absentPixels).compactMap { track, pixel in
      grid.isContradicting(pixel, minimum: options.cellPoints) ? track : nil
    }
    return comparison
  }
}
