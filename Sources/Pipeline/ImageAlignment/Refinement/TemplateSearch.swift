import Foundation
import Kernels
import SceneModel

/// The templates of a map's tracks, and the template matching in each photo.
struct TemplateSearch: Sendable {
  private let options: ObservationRefinement.Options
  private let photos: [Photo]
  private let extraction: TemplateExtraction
  /// The reference of each track; nil if it has none.
  private let references: [TrackReference?]
  private let templates: TemplateMatching.Templates

  /// A pending search in one photo.
  private struct Candidate: Sendable {
    var track: Int
    var photo: Int
    /// The observation to be refined; nil for a new one.
    var observation: Int?
    var expected: SIMD2<Double>
    var warp: SIMD4<Double>
  }

  /// Where a template is in a photo, in pixels of the full-size photo.
  private struct Find: Sendable {
    var pixel: SIMD2<Double>
    /// The covariance of `pixel`: xx, xy, yy.
    var covariance: SIMD3<Double>

    /// The geometric mean of the standard deviations along its axes.
    var deviation: Double {
      (covariance.x * covariance.z - covariance.y * covariance.y).squareRoot().squareRoot()
    }
  }

  /// Reads the templates of all tracks.
  init(
    _ map: SparseMap, features: [FeatureSet], photos: [Photo], images: ImageStore,
    _ options: ObservationRefinement.Options, _ context: StageContext
  ) throws {
    (self.options, self.photos) = (options, photos)
    extraction = TemplateExtraction(
      photos: photos, images: images, workingPixels: options.workingPixels)
    @Sendable func scale(_ photo: Int, _ feature: Int32) -> Double {
      let scales = features[photo].scales
      let scale = scales.indices.contains(Int(feature)) ? Double(scales[Int(feature)]) : 0
      return max(
        options.stepPerScale * scale,
        options.workingPixel(width: photos[photo].width, height: photos[photo].height))
    }
    references = try context.control.withoutProgress
      .parallelMap(map.tracks.count, inUnitsOf: SparseMap.tracksPerUnit) { [map] tracks in
        tracks.map { track in
          map.isTriangulated[track] ? TrackReference(track: track, of: map, scale: scale) : nil
        }
      }
    templates = try extraction.templates(of: references, context.control)
  }

  /// Moves the observations of the map to where their templates are found; deactivates those whose
  /// texture differs.
  func refine(_ map: inout SparseMap, _ context: StageContext) throws {
    let candidates = try candidates(context.control) { [map] track, reference in
      map.activeObservations(of: track).compactMap { index in
        let photo = Int(map.tracks.photos[index])
        guard photo != reference.photo, let (_, warp) = reference.warp(to: photo, in: map.photos)
        else { return nil }
        return Candidate(
          track: track, photo: photo, observation: index, expected: map.tracks.pixels[index],
          warp: warp)
      }
    }
    let finds = try finds(
      candidates, shift: options.maximumShift, correlation: options.minimumCorrelation, context)
    let deviation = Self.typicalDeviation(finds)
    for (photo, found) in finds.enumerated() {
      let confirmed = found.count { $0 != nil }
      let share = Double(confirmed) / Double(max(1, map.activeCount(ofPhoto: photo)))
      for (candidate, find) in zip(candidates[photo], found) {
        guard let index = candidate.observation else { continue }
        if let find {
          map.moveObservation(
            index, to: find.pixel,
            Whitening(covariance: find.covariance, deviation: deviation))
        } else if share >= options.minimumConfirmedShare {
          map.isActive[index] = false
        }
      }
    }
    map.dropUnsupportedPoints()
  }

  /// Adds observations of points in photos that should show them, within the photos' masks; returns
  /// how many.
  func extend(_ map: inout SparseMap, _ context: StageContext) throws -> Int {
    let neighbors = neighbors(map)
    let candidates = try candidates(context.control) { [self, map] track, reference in
      map.isTriangulated[track]
        ? newViews(of: track, reference, neighbors[reference.photo], map) : []
    }
    let finds = try finds(
      candidates, shift: options.maximumNewShift, correlation: options.minimumNewCorrelation,
      context)
    let deviation = Self.typicalDeviation(finds)
    var additions: [SparseMap.NewObservation] = []
    for (photo, found) in finds.enumerated() {
      for case (let candidate, let find?) in zip(candidates[photo], found) {
        additions.append(
          .init(
            track: candidate.track, photo: photo, pixel: find.pixel,
            whitening: Whitening(covariance: find.covariance, deviation: deviation)))
      }
    }
    try map.add(additions, context.control)
    return additions.count
  }

  /// The candidates that `find` returns for each track with a valid template, by photo.
  private func candidates(
    _ control: KernelControl,
    _ find: @escaping @Sendable (_ track: Int, TrackReference) -> [Candidate]
  ) throws -> [[Candidate]] {
    let found = try control.withoutProgress
      .parallelMap(references.indices, perUnitOf: SparseMap.tracksPerUnit) { [self] tracks in
        tracks.flatMap { track -> [Candidate] in
          guard let reference = references[track], templates.isValid[track] else { return [] }
          return find(track, reference)
        }
      }
    var candidates = [[Candidate]](repeating: [], count: photos.count)
    for candidate in found.joined() { candidates[candidate.photo].append(candidate) }
    return candidates
  }

  /// The searches in photos in which a point should be visible but has no active observation.
  private func newViews(
    of track: Int, _ reference: TrackReference, _ neighbors: [Int], _ map: SparseMap
  ) -> [Candidate] {
    let known = Set(map.activeObservations(of: track).map { Int(map.tracks.photos[$0]) })
    guard known.contains(reference.photo) else { return [] }
    var current = reference
    current.point = map.positions[track]
    let leastCosine = cos(options.maximumAngleDegrees * .pi / 180)
    return neighbors.compactMap { photo in
      guard !known.contains(photo), let pose = map.photos.poses[photo],
        (pose.center - current.point).normalized.dot(current.normal) >= leastCosine,
        let (pixel, warp) = current.warp(to: photo, in: map.photos),
        pixel.x > 0, pixel.y > 0, pixel.x < Double(photos[photo].width),
        pixel.y < Double(photos[photo].height)
      else { return nil }
      return Candidate(
        track: track, photo: photo, observation: nil, expected: pixel, warp: warp)
    }
  }

  /// For each photo, the photos that share the most points with it.
  private func neighbors(_ map: SparseMap) -> [[Int]] {
    (0..<photos.count).map { photo in
      var shared = [Int](repeating: 0, count: photos.count)
      for index in map.tracks.observationsOfPhoto[photo] where map.isActive[Int(index)] {
        let track = Int(map.tracks.trackOfObservation[Int(index)])
        for other in map.activeObservations(of: track) {
          shared[Int(map.tracks.photos[other])] += 1
        }
      }
      return Array(
        shared.indices.filter { $0 != photo && shared[$0] > 0 }
          .sorted { (-shared[$0], $0) < (-shared[$1], $1) }.prefix(options.neighbors))
    }
  }

  /// The median deviation; residuals are relative to it.
  private static func typicalDeviation(_ finds: [[Find?]]) -> Double {
    finds.joined().compactMap { $0?.deviation }.upperMedian ?? 1
  }

  /// The found positions of the candidates of each photo; nil if not found.
  private func finds(
    _ candidates: [[Candidate]], shift: Double, correlation: Double, _ context: StageContext
  ) throws -> [[Find?]] {
    var matching = TemplateMatching()
    matching.maximumShift = shift
    return try context.control.parallelMap(candidates.count) { [self, matching] photo in
      guard !candidates[photo].isEmpty else { return [] }
      let (image, factor) = try extraction.image(photo)
      let searches = candidates[photo].map { candidate in
        let reference = references[candidate.track]
        let source = photos[reference?.photo ?? photo]
        let from = options.workingPixel(width: source.width, height: source.height)
        return TemplateMatching.Search(
          template: candidate.track, step: (reference?.step ?? from) / from,
          warp: candidate.warp * from * factor.x, expected: candidate.expected * factor)
      }
      let isOnObject = try extraction.isOnObject(photo)
      let finds = try matching.matches(searches, of: templates, in: image)
      return zip(candidates[photo], finds).map { candidate, find in
        guard let find, find.zncc >= correlation,
          candidate.observation != nil || isOnObject(find.center)
        else { return nil }
        let floor = options.positionFloor * options.positionFloor
        let noise = find.covariance + SIMD3(floor, 0, floor)
        return Find(
          pixel: find.center / factor,
          covariance: noise / SIMD3(factor.x * factor.x, factor.x * factor.y, factor.y * factor.y))
      }
    }
  }
}
