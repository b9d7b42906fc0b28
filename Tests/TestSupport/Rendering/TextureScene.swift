import Foundation
import SceneModel

/// Scenes for the evaluation of the texture: one object, one light and the same cameras; each but
/// the first contains a disturbance that must not be visible in the result.
package enum TextureScene: String, CaseIterable, Sendable {
  case clean
  /// Exposures from one stop below to one above, drifting white balance, and vignetting.
  case exposure
  /// A third of the photos show a ball in front of the object, each at a different position.
  case intruder

  /// The parameters are those of `DenseScene.scene`.
  package func scene(
    width: Int = 1100, poses: [RigidTransform]? = nil, fineness: Double = 1
  ) -> RenderedScene {
    var scene = DenseScene.exposure.scene(width: width, poses: poses, fineness: fineness)
    if self != .exposure { scene.photography = Photography() }
    if self == .intruder { scene.intruder = Intruder() }
    return scene
  }

  /// The clean scene from poses between the cameras, without noise: held-out photos to compare a
  /// model with.
  package static func held(width: Int = 1100, fineness: Double = 1) -> RenderedScene {
    let poses = (0..<6).map { index in
      DenseScene.pose(
        turn: (Double(index) + 0.35) / 6, degrees: index.isMultiple(of: 2) ? 25 : 38, height: 0.12)
    }
    var scene = clean.scene(width: width, poses: poses, fineness: fineness)
    scene.noise = 0
    return scene
  }
}
