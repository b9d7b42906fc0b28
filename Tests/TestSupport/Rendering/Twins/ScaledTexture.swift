import SceneModel

/// A texture that is scaled about the origin.
struct ScaledTexture: SurfaceTexture {
  var texture: any SurfaceTexture
  var scale: Float

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    texture.color(at: point / scale, footprint: footprint / scale)
  }
}
