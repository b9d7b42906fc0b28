extension PointCloud {
  /// The points for which `isKept` is true, in their order.
  package func filtered(by isKept: [Bool]) -> PointCloud {
    var result = PointCloud()
    for index in positions.indices where isKept[index] { result.append(self, index) }
    return result
  }

  /// Appends point `index` of another cloud.
  package mutating func append(_ other: PointCloud, _ index: Int) {
    positions.append(other.positions[index])
    if index < other.normals.count { normals.append(other.normals[index]) }
    if index < other.colors.count { colors.append(other.colors[index]) }
    if index < other.consistency.count { consistency.append(other.consistency[index]) }
    if index < other.footprints.count { footprints.append(other.footprints[index]) }
    photoIndices.append(contentsOf: other.visiblePhotos(of: index))
    photoOffsets.append(UInt32(photoIndices.count))
  }
}
