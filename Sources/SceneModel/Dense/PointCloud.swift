/// Oriented, colored points as parallel arrays, in the world frame of the reconstruction.
package struct PointCloud: Sendable {
  package var positions: [SIMD3<Float>]
  /// Unit normals that point to the cameras' side of the surface.
  package var normals: [SIMD3<Float>]
  /// RGB.
  package var colors: [SIMD3<UInt8>]
  /// Mean ZNCC of the patch over the consistent photos, −1…1.
  package var consistency: [Float]
  /// Side length of the surface element represented by a point, in world units.
  package var footprints: [Float]
  /// `visiblePhotos(of: i)` are `photoIndices[photoOffsets[i]..<photoOffsets[i + 1]]`.
  package var photoOffsets: [UInt32]
  package var photoIndices: [UInt16]

  package init(
    positions: [SIMD3<Float>] = [], normals: [SIMD3<Float>] = [], colors: [SIMD3<UInt8>] = [],
    consistency: [Float] = [], footprints: [Float] = [], photoOffsets: [UInt32] = [0],
    photoIndices: [UInt16] = []
  ) {
    self.positions = positions
    self.normals = normals
    self.colors = colors
    self.consistency = consistency
    self.footprints = footprints
    self.photoOffsets = photoOffsets
    self.photoIndices = photoIndices
  }

  package var count: Int { positions.count }

  /// Indices of the photos that see point `index`, in ascending order.
  package func visiblePhotos(of index: Int) -> ArraySlice<UInt16> {
    photoIndices[visibilities(of: index)]
  }

  /// Where `photoIndices` has the photos that see point `index`: unlike a slice, it holds no
  /// reference, which threads would count one after the other.
  package func visibilities(of index: Int) -> Range<Int> {
    Int(photoOffsets[index])..<Int(photoOffsets[index + 1])
  }
}
