extension PointCloud {
  /// Appends all points of another cloud of the same reconstruction.
  package mutating func append(_ other: PointCloud) {
    let offset = photoOffsets.last ?? 0
    positions += other.positions
    normals += other.normals
    colors += other.colors
    consistency += other.consistency
    footprints += other.footprints
    photoIndices += other.photoIndices
    photoOffsets += other.photoOffsets.dropFirst().map { $0 + offset }
  }
}
