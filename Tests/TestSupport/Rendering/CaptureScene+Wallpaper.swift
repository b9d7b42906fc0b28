import SceneModel

extension CaptureScene {
  /// A statue with fine texture on a plain table, a meter in front of a wall with the wallpaper:
  /// frames of a video that was taken while moving on an arc of 105°. All of them show the wall,
  /// and some pairs also match by the wallpaper shifted by a period.
  ///
  /// - Parameters:
  ///   - width: width of the photos in pixels; the height is three quarters of it.
  ///   - fineness: scales the number of the object's triangles per side.
  package static func wallpaper(
    seed: UInt64 = 1, width: Int = 1000, photoCount: Int = 50, fineness: Double = 1
  ) -> CaptureScene {
    let mesh = CaptureObject.statue.mesh(fineness: fineness)
    var motion = CaptureMotion(of: mesh, photoCount: photoCount, seed: seed &* 619)
    motion.elevations = [12]
    motion.margin = 0.1
    let place = CaptureRoom(table: [0.45, 0.3], walls: [3, 1], height: 1.2)
    var lighting = CaptureRoom.lighting(seed: seed)
    // The sun shines on the wall.
    lighting.sunDirection.z = abs(lighting.sunDirection.z)
    return CaptureScene(
      mesh: mesh, texture: fur(seed: seed),
      surroundings: [
        place.tableSurface(cloth(seed: room(seed) &+ 401)),
        place.farWall(WallpaperTexture(seed: room(seed) &+ 402)),
        place.sideWalls(CaptureRoom.paint(seed: room(seed) &+ 403)),
        place.floorSurface(seed: room(seed) &+ 404),
      ],
      lighting: lighting, views: motion.arc(degrees: 105), width: width, seed: seed)
  }

  /// Fine vertical strands of brown and white.
  private static func fur(seed: UInt64) -> SolidTexture {
    var random = SeededGenerator(seed: seed &* 139 &+ 5)
    let palette = [0.05, 0.16, 0.32, 0.12, 0.6].map { lightness in
      SIMD3<Float>(
        lightness * (SIMD3(0.9, 0.65, 0.45) + 0.3 * SIMD3(repeating: random.uniform())))
    }
    var texture = SolidTexture(
      palette: palette, wavelength: 0.009, octaves: 4,
      seed: UInt32(truncatingIfNeeded: random.next()))
    texture.stretch = [1, 4, 1]
    return texture
  }

  private static func cloth(seed: UInt32) -> SolidTexture {
    SolidTexture(
      palette: [[0.3, 0.31, 0.33], [0.36, 0.37, 0.38], [0.42, 0.42, 0.42]], wavelength: 0.05,
      octaves: 5, seed: seed
    ).withContrast(0.4)
  }
}
