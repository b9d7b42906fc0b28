import Foundation
import SceneModel

/// A scene and the views of its dense stage as the processes read them that work on a block of its
/// views or tiles: without sparse points and surroundings, of which only few photos concern them.
struct SceneRecord: LargeUnitValue {
  private var cameras: [Camera]
  private var cameraOfPhoto: [ID<Camera>]
  private var poses: [RigidTransform?]
  private var worldFrame: WorldFrame
  /// Those in use, by photo ID.
  private var masks: [PhotoMask?]
  private var support: SupportPlane?
  private var selectedViews: [DenseViews.View]
  /// By the name of a step, those of all views.
  private var fingerprints: [String: Data]

  init(_ scene: ObjectScene, _ views: DenseViews) {
    let reconstruction = scene.reconstruction
    (cameras, poses) = (reconstruction.cameras, reconstruction.poses)
    cameraOfPhoto = reconstruction.photos.map(\.camera)
    worldFrame = reconstruction.worldFrame
    masks = scene.photos.ingested.photos.map(\.mask)
    support = scene.support
    selectedViews = views.views
    fingerprints = Dictionary(
      uniqueKeysWithValues: views.fingerprints.map { ($0.key.rawValue, Data(bytesOf: $0.value)) })
  }

  /// The scene of some photos; nil if these are others, or if the files of masks have changed.
  func scene(of photos: PhotoSet) -> ObjectScene? {
    var known = photos.ingested.photos
    guard known.count == poses.count else { return nil }
    for (index, camera) in cameraOfPhoto.enumerated() { known[index].camera = camera }
    let reconstruction = Reconstruction(
      cameras: cameras, photos: known, poses: poses, points: [], worldFrame: worldFrame)
    guard !photos.images.hasMasks, masks.contains(where: { $0 != nil }) else {
      return ObjectScene(photos, reconstruction)
    }
    guard masks.areIntact else { return nil }
    var scene = ObjectScene(photos, reconstruction, masks: masks)
    scene.support = support
    return scene
  }

  /// The views, without points.
  var views: DenseViews {
    DenseViews(
      selectedViews,
      Dictionary(
        uniqueKeysWithValues: fingerprints.compactMap { name, values in
          PatchWorkspace.Step(rawValue: name).map { ($0, values.values(of: UInt64.self)) }
        }))
  }
}
