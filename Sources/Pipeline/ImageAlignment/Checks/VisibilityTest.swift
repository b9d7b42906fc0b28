import Foundation
import Kernels
import SceneModel

/// A point of one photo that another photo is expected to show.
struct ExpectedPoint: Sendable {
  /// The point and its template in the first photo.
  var reference: TrackReference
  /// The expected position in the other photo, in pixels, and the local affine warp of the
  /// template.
  var pixel: SIMD2<Double>
  var warp: SIMD4<Double>
}

/// A visibility hypothesis: the points of photo `other` that `photo` should show if both poses are
/// correct, and the points that it demonstrably shows.
struct VisibilityHypothesis: Sendable {
  var other: Int
  var photo: Int
  var points: [ExpectedPoint] = []
  /// Pixels in `photo` of points that are matched features of both photos.
  var confirmedPixels: [SIMD2<Double>] = []
}

/// Predicts which points a photo should show, from its pose and the points it observes.
struct VisibilityPrediction {
  let photo: Int
  let pose: RigidTransform
  private let depths: DepthGrid
  /// Tracks observed by features of the photo, and their pixels.
  private let known: [Int32: SIMD2<Double>]

  /// `seen` lists the tracks observed by features of the photo.
  init(
    _ photo: Int, at pose: RigidTransform, seen: [(track: Int32, pixel: SIMD2<Double>)],
    _ map: SparseMap, _ options: SceneAmbiguityCheck.Options
  ) {
    (self.photo, self.pose) = (photo, pose)
    depths = DepthGrid(
      map.photos.cameras[Int(map.photos.cameraOfPhoto[photo])],
      seen.map { ($0.pixel, (pose * map.positions[Int($0.track)]).z) }, cells: options.cells)
    known = Dictionary(seen.map { ($0.track, $0.pixel) }) { first, _ in first }
  }

  /// Median depth of all points that the photo observes; nil without any.
  var medianDepth: Double? { depths.medianDepth }

  /// The points of another photo that this photo should show.
  func hypothesis(
    about other: Int, _ map: SparseMap, _ options: SceneAmbiguityCheck.Options,
    reference: (_ observation: Int) -> TrackReference
  ) -> VisibilityHypothesis {
    var hypothesis = VisibilityHypothesis(other: other, photo: photo)
    guard let theirs = map.photos.poses[other]?.center else { return hypothesis }
    var photos = map.photos
    photos.poses[photo] = pose
    for index in map.tracks.observationsOfPhoto[other].map(Int.init) where map.isActive[index] {
      if let pixel = known[map.tracks.trackOfObservation[index]] {
        hypothesis.confirmedPixels.append(pixel)
      } else if let point = expected(reference(index), from: theirs, photos, options) {
        hypothesis.points.append(point)
      }
    }
    let stride = max(
      1, (hypothesis.points.count + options.maximumPoints - 1) / options.maximumPoints)
    hypothesis.points = Swift.stride(from: 0, to: hypothesis.points.count, by: stride).map {
      hypothesis.points[$0]
    }
    return hypothesis
  }

  /// The expected position of a point observed from the center `theirs`; nil if it may be occluded,
  /// lies outside, or is viewed too differently.
  private func expected(
    _ reference: TrackReference, from theirs: SIMD3<Double>, _ photos: PosedPhotos,
    _ options: SceneAmbiguityCheck.Options
  ) -> ExpectedPoint? {
    let camera = photos.cameras[Int(photos.cameraOfPhoto[photo])]
    let (mine, their) = (pose.center - reference.point, theirs - reference.point)
    let ratio = mine.length / their.length
    let depth = (pose * reference.point).z
    let (limit, most) = (options.maximumAngleDegrees * .pi / 180, options.maximumDistanceRatio)
    guard depth > 0, ratio < most, 1 / ratio < most,
      mine.dot(their) > cos(limit) * mine.length * their.length,
      let (pixel, warp) = reference.warp(to: photo, in: photos)
    else { return nil }
    // The whole template, including the search range, must lie within the photo.
    let margin = VisibilityTest.templateReach * reference.step
    guard pixel.x > margin, pixel.y > margin, pixel.x < Double(camera.width) - margin,
      pixel.y < Double(camera.height) - margin,
      let nearestDepth = depths.nearestDepth(at: pixel),
      depth < options.depthTolerance * nearestDepth
    else { return nil }
    return ExpectedPoint(reference: reference, pixel: pixel, warp: warp)
  }
}

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
    let (center, ahead) = (pose.center, axis(pose))
    let leastCosine = cos(options.axisDegrees * .pi / 180)
    let near = map.registered.compactMap { other -> (distance: Double, photo: Int)? in
      guard other != photo, let theirs = map.photos.poses[other] else { return nil }
      let distance = (theirs.center - center).length
      return distance < reach && axis(theirs).dot(ahead) > leastCosine ? (distance, other) : nil
    }
    return near.sorted { ($0.distance, $0.photo) < ($1.distance, $1.photo) }
      .prefix(options.neighbors).map(\.photo)
  }

  // MARK: Evaluation

  /// The evidence for each hypothesis, in their order.
  func evaluate(
    _ hypotheses: [VisibilityHypothesis], _ control: KernelControl
  ) throws -> [SceneAmbiguityCheck.Evidence] {
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
      return evidence(hypothesis, Array(best[first..<first + hypothesis.points.count]))
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
        points[number].pixel, Self.templateReach * points[number].reference.step
      )
      let isShown = Self.corners.allSatisfy { isOnObject((pixel + reach * $0) * factor) }
      return templates.isValid[number] && isShown ? -1.0 : nil
    }
    var matching = TemplateMatching()
    matching.maximumShift =
      4 * (numbers.map { points[$0].reference.step }.max() ?? 1) * factor.x
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

  /// Half the side of a template plus the search range, in template samples.
  fileprivate static let templateReach = 10.0
  private static let corners: [SIMD2<Double>] = [[-1, -1], [1, -1], [-1, 1], [1, 1]]

  /// Starting positions of the search, in template samples.
  private static let offsets: [SIMD2<Double>] = [
    [0, 0], [2, 0], [-2, 0], [0, 2], [0, -2], [2, 2], [-2, -2], [2, -2], [-2, 2],
  ]

  private func evidence(
    _ hypothesis: VisibilityHypothesis, _ correlations: [Double?]
  ) -> SceneAmbiguityCheck.Evidence {
    var evidence = SceneAmbiguityCheck.Evidence(
      pair: PhotoPair(ID(hypothesis.other), ID(hypothesis.photo)))
    var grid = PresenceGrid(photos[hypothesis.photo], cells: options.cells)
    for (point, correlation) in zip(hypothesis.points, correlations) {
      guard let correlation else { continue }
      if correlation >= options.presentCorrelation {
        evidence.present += 1
        grid.countPresent(point.pixel)
      } else if correlation < options.absentCorrelation {
        evidence.absent += 1
        grid.countAbsent(point.pixel)
      }
    }
    hypothesis.confirmedPixels.forEach { grid.countPresent($0) }
    evidence.contradictingCells = grid.contradictingCells(minimum: options.cellPoints)
    return evidence
  }
}
