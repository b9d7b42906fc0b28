import Foundation
import SceneModel

/// Photos of an object that moves relative to its surroundings, or doesn't: the object is lit by
/// the fixed light of a room and has the same texture in all captures of the same seed.
package struct CaptureScene: Sendable {
  /// What moves from photo to photo.
  package struct View: Sendable {
    package var cameraFromRoom: RigidTransform
    package var roomFromObject: RigidTransform
    /// The plate of a turntable; nil if there is none.
    var roomFromPlate: RigidTransform?

    /// The pose of the camera relative to the object.
    package var cameraFromObject: RigidTransform { cameraFromRoom * roomFromObject }
  }

  package var object: CaptureObject
  package var capture: Capture
  package var surroundings: CaptureSurroundings
  package let seed: UInt64
  package let camera: Camera
  /// The object in its own frame.
  package let mesh: Mesh
  package let views: [View]

  /// - Parameters:
  ///   - width: width of the photos in pixels; the height is three quarters of it.
  ///   - photoCount: number of photos, half of them from each elevation or of each side.
  ///   - fineness: scales the number of the object's triangles per side.
  package init(
    _ object: CaptureObject, _ capture: Capture, _ surroundings: CaptureSurroundings,
    seed: UInt64 = 1, width: Int = 1000, photoCount: Int = 28, fineness: Double = 1
  ) {
    self.object = object
    self.capture = capture
    self.surroundings = surroundings
    self.seed = seed
    camera = Camera(
      width: width, height: width * 3 / 4, focalLength: SIMD2(repeating: 1.15 * Double(width)),
      calibration: .exif)
    mesh = object.mesh(fineness: fineness)
    let number = UInt64(Capture.allCases.firstIndex(of: capture) ?? 0)
    var motion = CaptureMotion(
      capture, of: object, mesh, photoCount: photoCount, seed: seed &* 613 &+ number)
    views = motion.views()
  }

  /// The scene when photo `index` is taken, in the frame of the room: only the photo and the mask
  /// with that index are part of the capture.
  package func scene(ofPhoto index: Int) -> RenderedScene {
    let view = views[index]
    let room = UInt32(truncatingIfNeeded: seed &* 7919)
    var surfaces = surroundings.surfaces(seed: room &+ 101)
    if let roomFromPlate = view.roomFromPlate {
      surfaces.append(CapturePlate.surface(roomFromPlate, seed: room &+ 211))
    }
    var scene = RenderedScene(
      object: RenderedScene.Surface(
        mesh: mesh.moved(by: view.roomFromObject), texture: texture,
        textureFromWorld: view.roomFromObject.inverse),
      surroundings: surfaces, camera: camera, poses: views.map(\.cameraFromRoom), seed: seed)
    scene.noise = 1.5
    scene.photography = Photography()
    (scene.lighting.ambient, scene.lighting.sky, scene.lighting.sun) = (0.7, 0.1, 0.2)
    return scene
  }

  /// Five colors from dark to light.
  private var texture: SolidTexture {
    let number = UInt64(CaptureObject.allCases.firstIndex(of: object) ?? 0)
    var random = SeededGenerator(seed: seed &* 97 &+ number)
    let palette = [0.04, 0.2, 0.42, 0.16, 0.72].map { lightness in
      let tint = SIMD3(random.uniform(), random.uniform(), random.uniform())
      return SIMD3<Float>(lightness * (0.55 + 0.6 * tint))
    }
    return SolidTexture(
      palette: palette, wavelength: 0.035, octaves: 7,
      seed: UInt32(truncatingIfNeeded: random.next()))
  }
}
