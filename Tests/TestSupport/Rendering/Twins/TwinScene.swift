import Foundation
import Kernels
import SceneModel

/// Photos of a `TwinObject` in its surroundings.
package struct TwinScene: Sendable {
  package let object: TwinObject
  /// Its poses are those of all photos, in the order of capture.
  package let scene: RenderedScene

  /// - Parameters:
  ///   - seed: determines shape, colors, surroundings and walk.
  ///   - width: width of the photos in pixels; the height is three quarters of it.
  ///   - photoCount: number of photos; nil selects that of the object.
  ///   - fineness: scales the number of the object's triangles per side.
  package init(
    _ object: TwinObject, seed: UInt64 = 1, width: Int = 1000, photoCount: Int? = nil,
    fineness: Float = 1, _ control: KernelControl = KernelControl()
  ) throws {
    self.object = object
    let surface = try object.model(seed: seed).surface(fineness: fineness, control)
    let camera = Camera(
      width: width, height: width * 3 / 4, focalLength: SIMD2(repeating: 1.15 * Double(width)),
      calibration: .exif)
    let (low, high) = surface.mesh.captureBounds
    // At this distance the ball around the object has `share` of the height of a photo.
    let distance = 1.15 / 0.75 * (high - low).length / object.share
    var walk = TwinWalk(
      around: (low + high) / 2, at: distance, seed: seed &* 4_271 &+ object.number)
    let surroundings = TwinSurroundings(object, seed: seed)
    var scene = RenderedScene(
      object: surface,
      surroundings: surroundings.surfaces, camera: camera,
      poses: object.poses(&walk, count: photoCount ?? object.photoCount), seed: seed)
    scene.noise = 1.5
    scene.photography = Photography()
    scene.lighting = surroundings.lighting
    scene.backdrop = surroundings.backdrop
    self.scene = scene
  }

  /// Whether a photo is held out: every fifth.
  package static func isHeldOut(_ index: Int) -> Bool { index % 5 == 2 }

  /// The file name of a photo. Names are in the order of capture.
  package static func name(_ index: Int) -> String { String(format: "IMG_%04d.jpg", index) }
}

extension TwinObject {
  /// The height of the ball around the object in the photos, relative to the height of the photos.
  /// Chosen, so that the object itself has a third to two thirds of it.
  fileprivate var share: Double {
    switch self {
    case .statuette, .marbleStatue: 0.62
    case .toyCar: 0.82
    case .paleVase, .apple: 0.7
    }
  }

  fileprivate func poses(_ walk: inout TwinWalk, count: Int) -> [RigidTransform] {
    switch self {
    case .statuette: walk.rings(count, degrees: [14, 33, 54])
    case .marbleStatue: walk.rings(count, degrees: [5, 19, 33])
    case .toyCar: walk.spiral(count, turns: 2.4, degrees: (15, 52))
    case .paleVase: walk.rings(count, degrees: [13, 34, 56])
    case .apple: walk.rings(count, degrees: [10, 28, 47, 66])
    }
  }
}
