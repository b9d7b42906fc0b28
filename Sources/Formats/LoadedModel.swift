import SceneModel

/// A model read from a file of any format.
package struct LoadedModel: Equatable, Sendable {
  /// The triangles of one material.
  package struct Part: Equatable, Sendable {
    /// World frame of the file: y up, in meters if the format has a unit.
    package var positions: [SIMD3<Float>] = []
    /// One per position, or empty.
    package var normals: [SIMD3<Float>] = []
    /// One per position, or empty; origin at the bottom left.
    package var textureCoordinates: [SIMD2<Float>] = []
    /// sRGB, one per position, or empty.
    package var colors: [SIMD3<UInt8>] = []
    /// Indices into `positions`.
    package var triangles: [Triangle] = []
    /// The texture of the base color, as in the file.
    package var baseColor: EncodedImage?
    /// A linear color that multiplies the texture, or the vertex colors.
    package var baseColorFactor = SIMD3<Float>(1, 1, 1)

    package init() {}

    /// The factor in sRGB.
    package var baseColorBytes: SIMD3<UInt8> { LinearColor(baseColorFactor).bytes }
  }

  /// None is empty.
  package var parts: [Part]
  /// Images and material files that the file refers to, but that are missing or in a format other
  /// than PNG, JPEG and WebP; in the order of the references.
  package var missingFiles: [String]

  package init(parts: [Part], missingFiles: [String] = []) {
    self.parts = parts
    self.missingFiles = missingFiles
  }

  /// The surface of all parts, with the normals and colors that every part has.
  package var mesh: Mesh {
    var mesh = Mesh()
    for part in parts {
      let base = UInt32(mesh.positions.count)
      mesh.positions += part.positions
      mesh.normals += part.normals
      mesh.colors += part.colors
      mesh.triangles += part.triangles.map { Triangle(base + $0.a, base + $0.b, base + $0.c) }
    }
    if mesh.normals.count != mesh.positions.count { mesh.normals = [] }
    if mesh.colors.count != mesh.positions.count { mesh.colors = [] }
    return mesh
  }
}
