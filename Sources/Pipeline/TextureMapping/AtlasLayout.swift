import Kernels
import SceneModel

/// Placement of the triangles in the textures.
struct AtlasLayout: Sendable {
  /// Side of the square textures in texels.
  var side: Int
  /// The texture index of each triangle; every texture in `0..<count` has triangles.
  var atlases: [Int]
  var count: Int
  /// Texel coordinates of each triangle's three corners; origin top left, y down.
  var corners: [SIMD2<Float>]
  /// Linear ratio of texels to photo pixels.
  var magnification: Float

  /// The triangles of one texture, ascending.
  func faces(in atlas: Int) -> [Int] { atlases.indices.filter { atlases[$0] == atlas } }

  /// The corners with those of other textures' triangles set to zero, so that these have no area.
  func corners(in atlas: Int) -> [SIMD2<Float>] {
    guard count > 1 else { return corners }
    return corners.indices.map { atlases[$0 / 3] == atlas ? corners[$0] : .zero }
  }

  /// The same layout for textures of another size.
  func scaled(toSide side: Int) -> AtlasLayout {
    var result = self
    let factor = Float(side) / Float(self.side)
    result.side = side
    result.magnification *= factor
    result.corners = corners.map { $0 * factor }
    return result
  }
}
