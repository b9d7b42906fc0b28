import Foundation
import SceneModel

extension PLY {
  /// Points whose rows are written at a time. Chosen: a few megabytes.
  private static let pointsPerBlock = 1 << 16
  /// Bytes of a row with some photos, for which space is reserved. Chosen.
  private static let usualRowSize = 48

  /// Writes a cloud; throws `OutputError`.
  ///
  /// Properties: x y z, nx ny nz, red green blue, consistency, footprint and the list photos
  /// (16-bit indices). Missing parts of the cloud are omitted.
  package static func write(_ cloud: PointCloud, to url: URL) throws {
    let parts = CloudParts(cloud)
    try AtomicFile.write(to: url) { append in
      try Array(parts.header.utf8).withUnsafeBytes(append)
      for start in stride(from: 0, to: cloud.count, by: pointsPerBlock) {
        var writer = ByteWriter(capacity: pointsPerBlock * usualRowSize)
        parts.append(start..<min(start + pointsPerBlock, cloud.count), to: &writer)
        try writer.bytes.withUnsafeBytes(append)
      }
    }
  }

  /// The bytes that `write` writes.
  package static func encode(_ cloud: PointCloud) -> [UInt8] {
    let parts = CloudParts(cloud)
    var writer = ByteWriter(capacity: parts.header.utf8.count + cloud.count * usualRowSize)
    writer.append(parts.header)
    parts.append(0..<cloud.count, to: &writer)
    return writer.bytes
  }

  /// Reads a cloud; points that are not finite are skipped. Throws `FormatError`.
  package static func readPointCloud(_ url: URL) throws -> PointCloud {
    try read(url) { reader in
      guard let vertex = reader.header.elements.first(where: { $0.name == "vertex" }),
        let columns = CloudColumns(vertex)
      else { throw FormatFault("it has no vertices with x, y and z") }
      var cloud = PointCloud()
      try reader.forEachRow { element, row in
        if element.name == "vertex" { try columns.append(row, of: element, to: &cloud) }
      }
      return cloud
    }
  }
}

/// The parts that the points of a cloud have, and so the rows of its file.
private struct CloudParts {
  private let cloud: PointCloud
  private let hasNormals, hasColors, hasConsistency, hasFootprints, hasPhotos: Bool

  init(_ cloud: PointCloud) {
    let count = cloud.count
    self.cloud = cloud
    hasNormals = cloud.normals.count == count && count > 0
    hasColors = cloud.colors.count == count && count > 0
    hasConsistency = cloud.consistency.count == count && count > 0
    hasFootprints = cloud.footprints.count == count && count > 0
    hasPhotos = cloud.photoOffsets.count == count + 1 && count > 0
  }

  var header: String {
    var header = PLY.headerStart(vertices: cloud.count, normals: hasNormals, colors: hasColors)
    if hasConsistency { header += "property float consistency\n" }
    if hasFootprints { header += "property float footprint\n" }
    if hasPhotos { header += "property list ushort ushort photos\n" }
    return header + "end_header\n"
  }

  func append(_ points: Range<Int>, to writer: inout ByteWriter) {
    for index in points {
      writer.append(cloud.positions[index])
      if hasNormals { writer.append(cloud.normals[index]) }
      if hasColors { writer.append(cloud.colors[index]) }
      if hasConsistency { writer.append(cloud.consistency[index]) }
      if hasFootprints { writer.append(cloud.footprints[index]) }
      if hasPhotos {
        let photos = cloud.visiblePhotos(of: index).prefix(Int(UInt16.max))
        writer.append(UInt16(photos.count))
        for photo in photos { writer.append(photo) }
      }
    }
  }
}

/// Property indices of a cloud's parts in a vertex row.
private struct CloudColumns {
  let position: SIMD3<Int>
  let normal: SIMD3<Int>?
  let color: SIMD3<Int>?
  let consistency: Int?
  let footprint: Int?
  let photos: Int?

  init?(_ element: PLYHeader.Element) {
    guard let position = PLY.triple(element, "x", "y", "z") else { return nil }
    self.position = position
    normal = PLY.triple(element, "nx", "ny", "nz")
    color =
      PLY.triple(element, "red", "green", "blue")
      ?? PLY.triple(element, "diffuse_red", "diffuse_green", "diffuse_blue")
    consistency = element.index(of: "consistency")
    footprint = element.index(of: "footprint")
    photos = element.listIndex(of: "photos")
  }

  func append(
    _ row: PLYRow, of element: PLYHeader.Element, to cloud: inout PointCloud
  ) throws {
    let point = PLY.vector(row, position)
    guard point.isFinite else { return }
    cloud.positions.append(point)
    if let normal { cloud.normals.append(PLY.vector(row, normal)) }
    if let color { cloud.colors.append(PLY.color(row, color, in: element)) }
    if let consistency { cloud.consistency.append(Float(row.scalars[consistency])) }
    if let footprint { cloud.footprints.append(Float(row.scalars[footprint])) }
    if let photos {
      for value in row.lists[photos] {
        guard let index = UInt16(exactly: value) else {
          throw FormatFault("\(value) is not a photo index")
        }
        cloud.photoIndices.append(index)
      }
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
  }
}
