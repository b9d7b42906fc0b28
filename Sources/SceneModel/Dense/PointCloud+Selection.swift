extension PointCloud {
  /// The points that are kept, in their order.
  package func filtered(by isKept: [Bool]) -> PointCloud {
    var result = PointCloud()
    let count = positions.indices.count { isKept[$0] }
    func kept<Value>(_ values: [Value]) -> [Value] {
      guard !values.isEmpty else { return [] }
      var kept: [Value] = []
      kept.reserveCapacity(count)
      for index in values.indices where isKept[index] { kept.append(values[index]) }
      return kept
    }
    result.positions = kept(positions)
    result.normals = kept(normals)
    result.colors = kept(colors)
    result.consistency = kept(consistency)
    result.footprints = kept(footprints)
    result.photoOffsets.reserveCapacity(count + 1)
    for index in positions.indices where isKept[index] {
      result.photoIndices.append(contentsOf: visiblePhotos(of: index))
      result.photoOffsets.append(UInt32(result.photoIndices.count))
    }
    return result
  }

  /// Removes the points that are not kept. Needs no memory for another cloud.
  package mutating func retain(_ isKept: [Bool]) {
    guard isKept.contains(false) else { return }
    var (points, photos) = (0, 0)
    for index in positions.indices where isKept[index] {
      for k in Int(photoOffsets[index])..<Int(photoOffsets[index + 1]) {
        photoIndices[photos] = photoIndices[k]
        photos += 1
      }
      points += 1
      photoOffsets[points] = UInt32(photos)
    }
    photoIndices.removeLast(photoIndices.count - photos)
    photoOffsets.removeLast(photoOffsets.count - 1 - points)
    positions.retain(isKept)
    normals.retain(isKept)
    colors.retain(isKept)
    consistency.retain(isKept)
    footprints.retain(isKept)
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

extension Array {
  /// Removes the elements that are not kept.
  fileprivate mutating func retain(_ isKept: [Bool]) {
    var count = 0
    for index in indices where isKept[index] {
      self[count] = self[index]
      count += 1
    }
    removeLast(self.count - count)
  }
}
