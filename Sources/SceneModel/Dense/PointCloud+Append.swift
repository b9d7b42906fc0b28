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

  /// Reserves space for points, and for the photos that they are visible in.
  package mutating func reserveCapacity(points: Int, photos: Int) {
    positions.reserveCapacity(points)
    normals.reserveCapacity(points)
    colors.reserveCapacity(points)
    consistency.reserveCapacity(points)
    footprints.reserveCapacity(points)
    photoIndices.reserveCapacity(photos)
    photoOffsets.reserveCapacity(points + 1)
  }
}
