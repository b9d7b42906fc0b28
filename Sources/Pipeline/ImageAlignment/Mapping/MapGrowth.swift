import Kernels
import SceneModel

/// The operations of incremental mapping on one view graph.
struct MapGrowth: Sendable {
  let options: IncrementalMapping.Options
  let graph: ViewGraph
  let photos: [Photo]
  /// The map without any registered photo.
  let empty: SparseMap
  let context: StageContext

  /// Bundle adjustment with priors at the cameras before mapping.
  var adjustment: MapAdjustment {
    MapAdjustment(options: options.adjustment, initialCameras: empty.photos.cameras)
  }

  /// Triangulation with the error limit of a growing map.
  var growthPoints: PointTriangulation {
    PointTriangulation(
      options: .init(
        maximumError: options.growthError, minimumAngleDegrees: options.minimumAngleDegrees))
  }

  /// The control of a kernel inside the loop: forwards cancellation and keeps the progress
  /// constant.
  func control(_ map: SparseMap) -> KernelControl {
    let done = Double(map.registered.count) / Double(max(1, photos.count))
    return context.control.part(from: done, to: done)
  }

  /// Returns all maps, with disjoint photos, the largest first; the first one grows from `start`,
  /// if given.
  func run(from start: SparseMap? = nil) throws -> [SparseMap] {
    var maps: [SparseMap] = []
    var isTaken = [Bool](repeating: false, count: photos.count)
    func take(_ map: SparseMap) {
      for photo in map.registered { isTaken[photo] = true }
      maps.append(map)
    }
    if let start { take(try grown(start, isTaken)) }
    for group in graph.connectedGroups {
      while true {
        let free = group.count { !isTaken[$0] }
        // The first map of a group takes at least a pair, a further one three photos.
        guard free >= (free == group.count ? 2 : 3), let map = try bestMap(within: group, isTaken)
        else { break }
        take(map)
      }
    }
    return maps.enumerated().sorted {
      (-$0.element.registered.count, -$0.element.pointCount, $0.offset)
        < (-$1.element.registered.count, -$1.element.pointCount, $1.offset)
    }.map(\.element)
  }

  /// The best map grown from a few initial pairs of unregistered photos.
  private func bestMap(within group: [Int], _ isTaken: [Bool]) throws -> SparseMap? {
    var best: SparseMap?
    var used = Set<PhotoPair>()
    let free = group.count { !isTaken[$0] }
    for _ in 0...options.restarts {
      guard let start = try initialMap(within: group, isTaken, &used) else { break }
      let map = try grown(start, isTaken)
      let isBetter = map.registered.count > (best?.registered.count ?? 1)
      if isBetter { best = map }
      if let best, 2 * best.registered.count >= free { break }
    }
    return best
  }

  /// Registers photo after photo until none can be added, then runs the final adjustment.
  private func grown(_ start: SparseMap, _ isTaken: [Bool]) throws -> SparseMap {
    var map = start
    var ranking = NextBestViewRanking(photos)
    var failures = [Int](repeating: 0, count: photos.count)
    var (lastPhotos, lastPoints) = (map.registered.count, map.pointCount)
    var isRelaxed = false
    while true {
      try context.step(map.registered.count, of: photos.count)
      guard try registerNext(&map, isTaken, isRelaxed, &ranking, &failures) else {
        if map.registered.count == photos.count { break }
        if isRelaxed {
          guard try registerWithoutStructure(&map, isTaken, &failures) else { break }
          continue
        }
        try adjustAndRetriangulate(&map)
        (isRelaxed, failures) = (true, failures.map { _ in 0 })
        continue
      }
      let isGrown =
        Double(map.registered.count) >= options.globalGrowth * Double(lastPhotos)
        || Double(map.pointCount) >= options.globalGrowth * Double(lastPoints)
      if isGrown {
        try adjustAndRetriangulate(&map)
        (lastPhotos, lastPoints) = (map.registered.count, map.pointCount)
      }
    }
    try finish(&map)
    return map
  }

  /// Registers the next best photo; false if none can be registered.
  private func registerNext(
    _ map: inout SparseMap, _ isTaken: [Bool], _ isRelaxed: Bool,
    _ ranking: inout NextBestViewRanking,
    _ failures: inout [Int]
  ) throws -> Bool {
    ranking.update(&map)
    let candidates = ranking.photos {
      !map.isRegistered($0) && !isTaken[$0] && failures[$0] < options.registrationTrials
    }
    for photo in candidates {
      if try register(photo, &map, isRelaxed) { return true }
      failures[photo] += 1
    }
    return false
  }

  /// Estimates a photo's pose from the points it observes (PnP), then triangulates the points that
  /// it adds.
  private func register(
    _ photo: Int, _ map: inout SparseMap, _ isRelaxed: Bool
  ) throws -> Bool {
    let seen = map.tracks.observationsOfPhoto[photo].map(Int.init)
      .filter { map.isTriangulated[Int(map.tracks.trackOfObservation[$0])] }
    var kernel = Resection.Options()
    kernel.maximumError = options.resectionError
    kernel.minimumInliers = isRelaxed ? options.relaxedMinimumInliers : options.minimumInliers
    kernel.seed = UInt64(photo) &* 1_000_003 &+ 1
    guard seen.count >= kernel.minimumInliers else { return false }
    let camera = map.photos.cameras[Int(map.photos.cameraOfPhoto[photo])]
    let found: Resection.Result
    do {
      found = try Resection(kernel).run(
        pixels: seen.map { map.tracks.pixels[$0] },
        points: seen.map { map.positions[Int(map.tracks.trackOfObservation[$0])] },
        camera: camera, control: control(map))
    } catch let error as KernelError where error != .outOfMemory {
      return false
    }
    guard Double(found.inlierCount) >= options.minimumInlierRatio * Double(seen.count) else {
      return false
    }
    map.register(photo, found.cameraFromWorld)
    for (index, isInlier) in zip(seen, found.isInlier) where isInlier { map.isActive[index] = true }
    try adjustment.adjustLocally(around: photo, &map, control(map))
    return try addPoints(of: photo, &map)
  }

  /// Updates the points that a new photo observes, and its pose; false if too few remain.
  func addPoints(of photo: Int, _ map: inout SparseMap) throws -> Bool {
    let tracks = map.tracks(ofPhoto: photo)
    try growthPoints.filter(tracks, in: &map, control(map))
    try growthPoints.triangulate(tracks, in: &map, control(map))
    try growthPoints.complete(tracks, in: &map, control(map))
    try adjustment.adjustLocally(around: photo, &map, control(map))
    try growthPoints.filter(tracks, in: &map, control(map))
    return dropWeakPhotos(&map, only: photo) == 0
  }

  /// Runs a global bundle adjustment, then filters, completes and re-triangulates the points.
  private func adjustAndRetriangulate(_ map: inout SparseMap) throws {
    let all = Array(map.isTriangulated.indices)
    try adjustment.adjustGlobally(&map, control(map))
    try growthPoints.filter(all, in: &map, control(map))
    try growthPoints.complete(all, in: &map, control(map))
    try growthPoints.triangulate(all, in: &map, control(map))
    dropWeakPhotos(&map)
  }

  /// Adjusts, splits tracks, completes and filters until little changes.
  private func finish(_ map: inout SparseMap) throws {
    try adjustAndRetriangulate(&map)
    map.splitTracks()
    let all = Array(map.isTriangulated.indices)
    var strict = growthPoints
    for round in 0..<options.finalRounds {
      try adjustment.adjustGlobally(&map, control(map))
      if round > 0 { strict.options.maximumError = options.finalError }
      var changes = try strict.filter(all, in: &map, control(map))
      changes += try strict.complete(all, in: &map, control(map))
      changes += try strict.triangulate(all, in: &map, control(map))
      dropWeakPhotos(&map)
      let activeCount = map.isActive.count { $0 }
      if round > 1, options.finalChangeDivisor * changes < activeCount { break }
    }
    try adjustment.adjustGlobally(&map, control(map))
    try strict.filter(all, in: &map, control(map))
    dropWeakPhotos(&map)
  }

  /// Removes photos with too few active observations; returns how many.
  @discardableResult
  private func dropWeakPhotos(_ map: inout SparseMap, only photo: Int? = nil) -> Int {
    let weak = (photo.map { [$0] } ?? map.registered)
      .filter { map.activeCount(ofPhoto: $0) < options.minimumObservations }
    for photo in weak { map.remove(photo) }
    return weak.count
  }
}
