import Foundation
import SceneModel

/// Scenes to judge the texture on: one object, one light and the same cameras, and each but the
/// first with something that must not be seen in the result.
package enum TextureScene: String, CaseIterable, Sendable {
  case clean
  /// Exposures from one stop below to one above, white balances that drift, and vignetting.
  case exposure
  /// A third of the photos show a ball before the object, each at another place.
  case intruder

  /// As `DenseScene.scene`.
  package func scene(
    width: Int = 1100, poses: [RigidTransform]? = nil, fineness: Double = 1
  ) -> RenderedScene {
    var scene = DenseScene.exposure.scene(width: width, poses: poses, fineness: fineness)
    if self != .exposure { scene.photography = Photography() }
    if self == .intruder { scene.intruder = Intruder() }
    return scene
  }

  /// The clean scene from between the cameras, without noise: photos to compare a model with.
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
