extension MapGrowth {
  /// Failure count of a photo whose only trial without points was used. Chosen: above every number
  /// of trials.
  private static let maximumFailures = 100

  /// Registers one photo by its pairs with registered photos only, without scene points; false if
  /// none can be registered. Each photo has one trial.
  func registerWithoutStructure(
    _ map: inout SparseMap, _ isTaken: [Bool], _ failures: inout [Int]
  ) throws -> Bool {
    for photo in photos.indices
    where !map.isRegistered(photo) && !isTaken[photo] && failures[photo] < Self.maximumFailures {
      let pairs = graph.pairs.filter {
        $0.pair.first.index == photo || $0.pair.second.index == photo
      }
      let pose = StructurelessPose(options: options.structurelessPose)
        .run(photo, pairs: pairs, poses: map.photos.poses)
      guard let pose else { continue }
      failures[photo] = Self.maximumFailures
      map.register(photo, pose)
      // The pose is rough: its points may have large errors until it is adjusted.
      var roughPoints = growthPoints
      roughPoints.options.maximumError = options.structurelessErrorFactor * options.growthError
      let tracks = map.tracks(ofPhoto: photo)
      try roughPoints.complete(tracks, in: &map, control(map))
      try roughPoints.triangulate(tracks, in: &map, control(map))
      try adjustment.adjustLocally(around: photo, &map, control(map))
      let isSupported = try addPoints(of: photo, &map)
      if isSupported && map.activeCount(ofPhoto: photo) >= options.minimumInliers { return true }
      map.remove(photo)
    }
    return false
  }
}
