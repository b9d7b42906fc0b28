import Foundation
import SceneModel

/// Scenes that are hard to align.
extension RenderedScene {
  /// The scene with other cameras.
  package func seen(from poses: [RigidTransform], camera: Camera? = nil) -> RenderedScene {
    RenderedScene(
      object: surfaces[0], surroundings: Array(surfaces.dropFirst()),
      camera: camera ?? self.camera, poses: poses, seed: seed)
  }

  /// A textured table without an object.
  package static func plane(
    photoCount: Int = 12, width: Int = 480, height: Int = 360
  ) -> RenderedScene {
    let poses = (0..<photoCount).map { index in
      let azimuth = 2 * .pi * Double(index) / Double(photoCount)
      let elevation = (index.isMultiple(of: 2) ? 40.0 : 55.0) * .pi / 180
      let offset = SIMD3(
        cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth))
      return RigidTransform.lookingAt([0, 0, 0], from: offset * 0.7)
    }
    return RenderedScene(
      object: Surface(
        mesh: tableMesh(halfSide: 0.6),
        texture: SolidTexture(
          palette: [
            [0.10, 0.06, 0.035], [0.36, 0.24, 0.13], [0.58, 0.47, 0.33], [0.8, 0.8, 0.7],
          ],
          wavelength: 0.07, octaves: 6, seed: 9)),
      surroundings: [],
      camera: Camera(
        width: width, height: height, focalLength: SIMD2(repeating: 1.15 * Double(width)),
        calibration: .exif),
      poses: poses)
  }
}
