import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

@Suite struct PLYTests {
  static let cloud = PointCloud(
    positions: [[0, 1, -2.5], [1e-7, 3.25, 4], [7, 8, 9]],
    normals: [[0, 0, 1], [0, 1, 0], [1, 0, 0]],
    colors: [[1, 2, 3], [255, 0, 128], [9, 8, 7]],
    consistency: [0.5, -1, 1], footprints: [0.001, 0.002, 0.003],
    photoOffsets: [0, 2, 2, 5], photoIndices: [0, 999, 1, 2, 65535])

  @Test func cloudRoundTrips() throws {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("points.ply")
      try PLY.write(Self.cloud, to: url)
      let read = try PLY.readPointCloud(url)
      #expect(read.positions == Self.cloud.positions)
      #expect(read.normals == Self.cloud.normals)
      #expect(read.colors == Self.cloud.colors)
      #expect(read.consistency == Self.cloud.consistency)
      #expect(read.footprints == Self.cloud.footprints)
      #expect(read.photoOffsets == Self.cloud.photoOffsets)
      #expect(read.photoIndices == Self.cloud.photoIndices)
    }
  }

  @Test func largeCloudsAreWrittenInBlocks() throws {
    var cloud = PointCloud()
    while cloud.count < 200_000 { cloud.append(cloud.count == 0 ? Self.cloud : cloud) }
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("points.ply")
      try PLY.write(cloud, to: url)
      #expect(try Data(contentsOf: url) == Data(PLY.encode(cloud)))
    }
  }

  @Test func meshRoundTrips() throws {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("surface.ply")
      var mesh = Sample.sphere(rings: 5).mesh
      mesh.colors = mesh.positions.indices.map { [UInt8($0 % 256), 7, 255] }
      try PLY.write(mesh, to: url)
      let read = try PLY.readMesh(url)
      #expect(read.positions == mesh.positions)
      #expect(read.normals == mesh.normals)
      #expect(read.colors == mesh.colors)
      #expect(read.triangles == mesh.triangles)
    }
  }

  @Test func quadsRoundTripAsTrianglePairs() throws {
    let mesh = Sample.sphere(rings: 3).mesh
    let bytes = PLY.encode(mesh, halves: [2..<6, 8..<10])
    let header = String(decoding: bytes.prefix(400), as: UTF8.self)
    #expect(header.contains("element face \(mesh.triangles.count - 3)\n"))
    let back = try read(bytes, PLY.readMesh)
    #expect(back.triangles == mesh.triangles && back.positions == mesh.positions)
  }

  @Test func emptyValuesRoundTrip() throws {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("empty.ply")
      try PLY.write(PointCloud(), to: url)
      #expect(try PLY.readPointCloud(url).count == 0)
      try PLY.write(Mesh(), to: url)
      #expect(try PLY.readMesh(url).triangles.isEmpty)
    }
  }

  @Test func unknownPropertiesAreSkippedAndQuadsAreSplit() throws {
    let text = """
      ply\r
      format ascii 1.0\r
      comment made by hand
      element material 1
      property list uchar int ids
      property float shine
      element vertex 4
      property double x
      property float quality
      property double y
      property double z
      property float red
      property float green
      property float blue
      element face 1
      property uchar flags
      property list uchar int vertex_index
      end_header
      2 5 6 0.5
      0 9 0 0 1 0 0
      1 9 0 0 0 1 0
      1 9 1 0 0 0 1
      0 9 1 0 0.5 2 -1
      1 4 0 1 2 3

      """
    let mesh = try read(Array(text.utf8), PLY.readMesh)
    #expect(mesh.positions == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    #expect(mesh.colors == [[255, 0, 0], [0, 255, 0], [0, 0, 255], [128, 255, 0]])
    #expect(mesh.triangles == [Triangle(0, 1, 2), Triangle(0, 2, 3)])
  }

  @Test func bigEndianFilesAreRead() throws {
    var bytes = Array(
      """
      ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
      property short z\nend_header\n
      """
      .utf8)
    bytes += [0x3F, 0x80, 0, 0, 0xC0, 0, 0, 0, 0xFF, 0xFE]
    let cloud = try read(bytes, PLY.readPointCloud)
    #expect(cloud.positions == [SIMD3<Float>(1, -2, -2)])
  }

  @Test(arguments: [
    "", "ply", "plx\nend_header\n", "ply\nend_header\n", "ply\nformat ascii 2 3\nend_header\n",
    "ply\nformat ascii 1.0\nproperty float x\nend_header\n",
    "ply\nformat ascii 1.0\nelement vertex -1\nend_header\n",
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
    "ply\nformat ascii 1.0\nelement vertex 9999999999999999999999\nend_header\n",
    """
    ply\nformat binary_little_endian 1.0\nelement vertex 9223372036854775807\nproperty double x\n\
    property double y\nproperty double z\nend_header\n
    """,
    """
    ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\n\
    property float y\nproperty float z\nend_header\nabc
    """,
    """
    ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    end_header\n1 two 3\n
    """,
    """
    ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n-3 0 0 0\n
    """,
    """
    ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n2000000000 0 0 0\n
    """,
    """
    ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n3 0 0 1\n
    """,
    """
    ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list float float vertex_indices\nend_header\n0 0 0\nnan 0 0 1\n
    """,
    """
    ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
    end_header\ninf 0 0\n
    """,
  ])
  func damagedFilesAreErrors(_ text: String) throws {
    #expect(throws: FormatError.self) { try read(Array(text.utf8), PLY.readMesh) }
  }

  @Test func everyTruncationIsAnError() throws {
    let bytes = PLY.encode(Self.cloud)
    for length in 0..<bytes.count {
      #expect(throws: FormatError.self) {
        try read(Array(bytes.prefix(length)), PLY.readPointCloud)
      }
    }
  }

  @Test func missingFileIsReported() throws {
    #expect {
      try PLY.readMesh(URL(fileURLWithPath: "/nowhere/at/all.ply"))
    } throws: {
      $0.localizedDescription.contains("/nowhere/at/all.ply")
    }
  }

  private func read<Value>(_ bytes: [UInt8], _ body: (URL) throws -> Value) throws -> Value {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("x.ply")
      try Data(bytes).write(to: url)
      return try body(url)
    }
  }
}
