import Foundation
import SceneModel

/// Photos of an object that moves relative to its surroundings, or doesn't, in the fixed light of a
/// room.
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

  package let seed: UInt64
  package let camera: Camera
  /// The object in its own frame.
  package let mesh: Mesh
  /// In the frame of the object.
  let texture: any SurfaceTexture
  /// What stays in place in the room.
  let surroundings: [RenderedScene.Surface]
  let lighting: RenderedScene.Lighting
  package let views: [View]

  /// - Parameter width: width of the photos in pixels; the height is three quarters of it.
  init(
    mesh: Mesh, texture: any SurfaceTexture, surroundings: [RenderedScene.Surface],
    lighting: RenderedScene.Lighting = .room, views: [View], width: Int, seed: UInt64
  ) {
    self.seed = seed
    camera = Camera(
      width: width, height: width * 3 / 4, focalLength: SIMD2(repeating: 1.15 * Double(width)),
      calibration: .exif)
    self.mesh = mesh
    self.texture = texture
    self.surroundings = surroundings
    self.lighting = lighting
    self.views = views
  }

  /// One of the objects, which has the same texture in all captures of the same seed.
  ///
  /// - Parameters:
  ///   - width: width of the photos in pixels; the height is three quarters of it.
  ///   - photoCount: number of photos, half of them from each elevation or of each side.
  ///   - fineness: scales the number of the object's triangles per side.
  package init(
    _ object: CaptureObject, _ capture: Capture, _ surroundings: CaptureSurroundings,
    seed: UInt64 = 1, width: Int = 1000, photoCount: Int = 28, fineness: Double = 1
  ) {
    let mesh = object.mesh(fineness: fineness)
    let number = UInt64(Capture.allCases.firstIndex(of: capture) ?? 0)
    var motion = CaptureMotion(of: mesh, photoCount: photoCount, seed: seed &* 613 &+ number)
    // A hand also shifts the object.
    if capture == .hand { motion.margin = 0.06 }
    self.init(
      mesh: mesh, texture: object.texture(seed: seed),
      surroundings: surroundings.surfaces(seed: Self.room(seed) &+ 101),
      views: motion.views(capture, of: object), width: width, seed: seed)
  }

  /// The scene when photo `index` is taken, in the frame of the room: only the photo and the mask
  /// with that index are part of the capture.
  package func scene(ofPhoto index: Int) -> RenderedScene {
    let view = views[index]
    var surfaces = surroundings
    if let roomFromPlate = view.roomFromPlate {
      surfaces.append(CapturePlate.surface(roomFromPlate, seed: Self.room(seed) &+ 211))
    }
    var scene = RenderedScene(
      object: RenderedScene.Surface(
        mesh: mesh.moved(by: view.roomFromObject), texture: texture,
        textureFromWorld: view.roomFromObject.inverse),
      surroundings: surfaces, camera: camera, poses: views.map(\.cameraFromRoom), seed: seed)
    scene.noise = 1.5
    scene.photography = Photography()
    scene.lighting = lighting
    return scene
  }

  /// The seed of the textures of a room.
  static func room(_ seed: UInt64) -> UInt32 { UInt32(truncatingIfNeeded: seed &* 7919) }
}

extension CaptureObject {
  /// Five colors from dark to light.
  func texture(seed: UInt64) -> SolidTexture {
    let number = UInt64(CaptureObject.allCases.firstIndex(of: self) ?? 0)
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

extension RenderedScene.Lighting {
  /// Bright from all sides, with weak shadows.
  static var room: RenderedScene.Lighting {
    var lighting = RenderedScene.Lighting()
    (lighting.ambient, lighting.sky, lighting.sun) = (0.7, 0.1, 0.2)
    return lighting
  }
}
