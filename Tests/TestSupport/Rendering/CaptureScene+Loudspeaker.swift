import SceneModel

/// How camera and loudspeaker move from photo to photo.
package enum LoudspeakerMotion: String, CaseIterable, Sendable {
  /// The loudspeaker stands still, and the camera moves around it.
  case still
  /// The camera is hand-held in one place, and another hand turns the loudspeaker on the table, by
  /// irregular steps.
  case hand
}

extension CaptureScene {
  /// A black loudspeaker with hardly any texture on a wooden table: photos from one elevation on a
  /// full ring. Where it is turned, the grain of the table connects all photos, but not by the
  /// object.
  ///
  /// - Parameters:
  ///   - width: width of the photos in pixels; the height is three quarters of it.
  ///   - fineness: scales the number of the loudspeaker's triangles per side.
  package static func loudspeaker(
    _ motion: LoudspeakerMotion, seed: UInt64 = 1, width: Int = 1000, photoCount: Int = 24,
    fineness: Double = 1
  ) -> CaptureScene {
    let mesh = Loudspeaker.mesh(fineness: fineness)
    let number = UInt64(LoudspeakerMotion.allCases.firstIndex(of: motion) ?? 0)
    var poses = CaptureMotion(of: mesh, photoCount: photoCount, seed: seed &* 617 &+ number)
    poses.elevations = [22.5]
    (poses.margin, poses.sway, poses.completesTurn) = (0.06, 0.012, true)
    let paint = CaptureRoom.paint(seed: room(seed) &+ 302)
    let place = CaptureRoom()
    return CaptureScene(
      mesh: mesh, texture: LoudspeakerTexture(seed: seed),
      surroundings: [
        place.tableSurface(WoodTexture(seed: room(seed) &+ 301)), place.farWall(paint),
        place.sideWalls(paint), place.nearWall(paint), place.floorSurface(seed: room(seed) &+ 303),
      ],
      lighting: CaptureRoom.lighting(seed: seed),
      views: motion == .hand ? poses.hand() : poses.walk(), width: width, seed: seed)
  }
}
