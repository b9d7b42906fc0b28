import Kernels
import SceneModel

/// Incremental structure from motion: grows a reconstruction from one pair of photos, one photo at
/// a time (Snavely et al., "Photo tourism", 2006; Schönberger and Frahm, "Structure-from-motion
/// revisited", CVPR 2016).
package struct IncrementalMapping: Sendable {
  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the largest reconstruction of the view graph, grown from `empty`, which holds the
  /// tracks, and from `start` if given; otherwise in the frame of its first photo, with the
  /// baseline of the initial pair as unit. `unregistered` gives the reasons why photos are missing.
  func run(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], empty: SparseMap,
    from start: SparseMap?, _ context: StageContext
  ) throws -> Reconstruction {
    let growth = MapGrowth(
      options: options, graph: graph, photos: photos, empty: empty, context: context)
    let maps = try growth.run(from: start)
    context.notes.record("components", Double(maps.count))
    var best = maps.first ?? growth.empty
    if best.registered.isEmpty { best = growth.empty }
    return try reconstruction(
      best, others: Array(maps.dropFirst()), graph, features, photos, context.control)
  }

  private func reconstruction(
    _ map: SparseMap, others: [SparseMap], _ graph: ViewGraph, _ features: [FeatureSet],
    _ photos: [Photo], _ control: KernelControl
  ) throws -> Reconstruction {
    var cameras = map.photos.cameras
    for photo in map.registered {
      cameras[Int(map.photos.cameraOfPhoto[photo])].calibration = .refined
    }
    return Reconstruction(
      cameras: cameras, photos: photos, poses: map.photos.poses,
      points: try map.scenePoints(features, control),
      unregistered: unregistered(map, others: others, graph, features, photos))
  }
}
