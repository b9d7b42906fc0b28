import Kernels
import SceneModel

extension MapAdjustment {
  /// Removes camera parameters that explain next to nothing (model selection).
  ///
  /// Measurement errors aren't independent, so nearly every parameter appears significant, and with
  /// few photos it distorts the poses. Among the models with k2 = 0, without distortion, and
  /// without distortion and with a centered principal point, the simplest one is chosen whose cost
  /// is higher by less than `simplificationTolerance`. The decision is made on a subset of the
  /// points; the map isn't adjusted.
  mutating func simplifyCameras(_ map: inout SparseMap, _ control: KernelControl) throws {
    guard fixedParameters.isEmpty else { return }
    var probe = map.thinned(toObservations: options.simplificationObservations)
    let limit = (1 + options.simplificationTolerance) * (try cost(of: &probe, control))
    for fixedParameters: BundleAdjustment.CameraFreedom in [
      [.k2], [.k1, .k2], [.k1, .k2, .principalPoint],
    ] {
      var (trial, simpler) = (probe, self)
      simpler.fixedParameters = fixedParameters
      simpler.resetFixedParameters(&trial)
      guard try simpler.cost(of: &trial, control) <= limit else { break }
      self.fixedParameters = fixedParameters
    }
    resetFixedParameters(&map)
  }

  /// Runs a global adjustment and returns the robust cost.
  private func cost(of map: inout SparseMap, _ control: KernelControl) throws -> Double {
    try adjustGlobally(&map, control)?.finalCost ?? .infinity
  }

  /// Resets the excluded parameters to their initial values.
  private func resetFixedParameters(_ map: inout SparseMap) {
    for index in map.photos.cameras.indices {
      if fixedParameters.contains(.k1) { map.photos.cameras[index].distortion.x = 0 }
      if fixedParameters.contains(.k2) { map.photos.cameras[index].distortion.y = 0 }
      if fixedParameters.contains(.principalPoint) {
        map.photos.cameras[index].principalPoint = initialCameras[index].principalPoint
      }
    }
  }
}

extension SparseMap {
  /// The map with only every n-th point, so that about `count` observations remain.
  fileprivate func thinned(toObservations count: Int) -> SparseMap {
    let step = isActive.count { $0 } / max(1, count) + 1
    var map = self
    for track in 0..<tracks.count where track % step != 0 && isTriangulated[track] {
      map.dropPoint(track)
    }
    return map
  }
}
