/// The colors of a surface.
package protocol SurfaceTexture: Sendable {
  /// Linear RGB of a point. Details that a pixel of width `footprint` can't resolve are omitted.
  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float>
}

extension SurfaceTexture {
  /// The fraction of a pixel of width `footprint` inside of an edge that is `distance` away; the
  /// distance of points inside is negative.
  package func coverage(_ distance: Float, _ footprint: Float) -> Float {
    min(max(0.5 - distance / max(footprint, 1e-6), 0), 1)
  }

  /// How much of a detail of width `size` a pixel of width `footprint` resolves, 0…1.
  package func resolved(_ size: Float, _ footprint: Float) -> Float {
    min(max(size / max(footprint, 1e-12) - 1.5, 0), 1)
  }
}
