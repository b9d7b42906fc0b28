import DamagedInput
import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

/// Damaged files give a value or an error. A reader that traps ends the test process.
@Suite struct DamagedFilesTests {
  private static let ascii = Array(
    """
    ply
    format ascii 1.0
    comment a square
    element vertex 4
    property float x
    property float y
    property float z
    property uchar red
    property uchar green
    property uchar blue
    element face 1
    property list uchar int vertex_indices
    end_header
    0 0 0 255 0 0
    1 0 0 0 255 0
    1 1 0 0 0 255
    0 1 0 9 9 9
    4 0 1 2 3

    """.utf8)

  private static var mesh: [UInt8] {
    var mesh = Sample.sphere(rings: 3).mesh
    mesh.colors = mesh.positions.map { _ in [1, 2, 3] }
    return PLY.encode(mesh, halves: [2..<6])
  }

  /// Reads each copy; returns the numbers of values and of errors.
  private func outcomes<Value>(
    of copies: some Sequence<[UInt8]>, named name: String = "file",
    _ read: (URL) throws -> Value, check: (Value) -> Bool
  ) throws -> (values: Int, errors: Int) {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent(name)
      var (values, errors) = (0, 0)
      for copy in copies {
        try Data(copy).write(to: url)
        do {
          #expect(check(try read(url)))
          values += 1
        } catch is FormatError {
          errors += 1
        }
      }
      return (values, errors)
    }
  }

  private func isConsistent(_ mesh: Mesh) -> Bool {
    let count = mesh.positions.count
    return (mesh.normals.isEmpty || mesh.normals.count == count)
      && (mesh.colors.isEmpty || mesh.colors.count == count)
      && mesh.triangles.allSatisfy { [$0.a, $0.b, $0.c].allSatisfy { $0 < count } }
  }

  private func isConsistent(_ cloud: PointCloud) -> Bool {
    let count = cloud.positions.count
    return [cloud.normals.count, cloud.colors.count, cloud.consistency.count].allSatisfy {
      $0 == 0 || $0 == count
    } && Int(cloud.photoOffsets.last ?? 0) == cloud.photoIndices.count
  }

  @Test func everyTruncatedMeshIsRefused() throws {
    let whole = DamagedInput(Self.mesh)
    let result = try outcomes(of: whole.truncations(), PLY.readMesh, check: isConsistent)
    #expect(result.values == 0 && result.errors == whole.bytes.count)
  }

  @Test func everyTruncatedCloudIsRefused() throws {
    let whole = DamagedInput(PLY.encode(PLYTests.cloud))
    let result = try outcomes(of: whole.truncations(), PLY.readPointCloud, check: isConsistent)
    #expect(result.values == 0 && result.errors == whole.bytes.count)
  }

  @Test(arguments: [false, true]) func damagedMeshesGiveAValueOrAnError(isText: Bool) throws {
    let copies = DamagedInput(isText ? Self.ascii : Self.mesh).mutations(3000, seed: 1, header: 300)
    let result = try outcomes(of: copies, PLY.readMesh, check: isConsistent)
    // Both must occur, or the damage is not what the test intends.
    #expect(result.values > 100 && result.errors > 300)
  }

  @Test(arguments: [false, true]) func damagedCloudsGiveAValueOrAnError(isText: Bool) throws {
    let copies = DamagedInput(isText ? Self.ascii : PLY.encode(PLYTests.cloud)).mutations(
      3000, seed: 2, header: 300)
    let result = try outcomes(of: copies, PLY.readPointCloud, check: isConsistent)
    #expect(result.values > 100 && result.errors > 300)
  }

  @Test func truncatedTextMeshesGiveAValueOrAnError() throws {
    let result = try outcomes(
      of: DamagedInput(Self.ascii).truncations(), PLY.readMesh, check: isConsistent)
    // Only the line break at the end may be missing.
    #expect(result.values == 1)
  }

  @Test func repeatedElementsAreRefused() throws {
    let header = """
      ply
      format ascii 1.0
      element vertex 1
      property float x
      property float y
      property float z
      element vertex 1
      property float w
      end_header
      1 2 3
      4

      """
    for read in [{ _ = try PLY.readMesh($0) }, { _ = try PLY.readPointCloud($0) }]
      as [(URL) throws -> Void]
    {
      let result = try outcomes(of: [Array(header.utf8)], read, check: { _ in true })
      #expect(result.errors == 1)
    }
  }

  @Test(
    arguments: [("cameras.txt", 5), ("images.txt", 6), ("points3D.txt", 7)] as [(String, UInt64)])
  func damagedCOLMAPTextGivesAValueOrAnError(name: String, seed: UInt64) throws {
    try withTemporaryFolder { folder in
      try COLMAPText.write(COLMAPTextTests.reconstruction, to: folder)
      let url = folder.appendingPathComponent(name)
      let whole = DamagedInput([UInt8](try Data(contentsOf: url)))
      var (values, errors) = (0, 0)
      func read(_ copy: [UInt8]) throws {
        try Data(copy).write(to: url)
        do {
          let model = try COLMAPText.read(folder)
          #expect(model.poses.count == model.photos.count)
          #expect(model.photos.allSatisfy { $0.camera.index < model.cameras.count })
          for point in model.points {
            #expect(point.track.allSatisfy { $0.photo.index < model.photos.count })
          }
          values += 1
        } catch is FormatError {
          errors += 1
        } catch is UnsupportedCameraModel {
          errors += 1
        }
      }
      for copy in whole.truncations() { try read(copy) }
      for copy in whole.mutations(2000, seed: seed, header: whole.bytes.count) { try read(copy) }
      #expect(values > 50 && errors > 50)
    }
  }
}
