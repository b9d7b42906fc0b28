import DamagedInput
import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

@Suite struct COLMAPBinaryTests {
  /// The bytes of numbers, little-endian, as COLMAP writes them.
  private struct Bytes {
    var bytes: [UInt8] = []

    mutating func add<Value: BitwiseCopyable>(_ values: Value...) {
      for value in values { withUnsafeBytes(of: value) { bytes += $0 } }
    }
  }

  private static var cameras: [UInt8] {
    var file = Bytes()
    file.add(UInt64(2))
    file.add(UInt32(7), UInt32(4))
    file.add(UInt64(640), UInt64(480))
    file.add(500.5, 501, 320.25, 240, -0.1, 0.01, 1e-4, -2e-4)
    file.add(UInt32(3), UInt32(2))
    file.add(UInt64(100), UInt64(50))
    file.add(90.0, 50, 25, 0.125)
    return file.bytes
  }

  private static var images: [UInt8] {
    var file = Bytes()
    file.add(UInt64(2))
    for (id, camera, name) in [(5, 7, "a b.jpg"), (2, 3, "sub/c.jpg")] {
      file.add(UInt32(id))
      file.add(0.6, 0, 0.8, 0, 1, 2, Double(id))
      file.add(UInt32(camera))
      file.bytes += Array(name.utf8) + [0]
      file.add(UInt64(2))
      for keypoint in 0..<2 {
        file.add(Double(10 * id + keypoint), 0.5)
        file.add(UInt64.max)
      }
    }
    return file.bytes
  }

  private static var points: [UInt8] {
    var file = Bytes()
    file.add(UInt64(1))
    file.add(UInt64(99))
    file.add(1.0, 2, 3)
    file.bytes += [10, 20, 30]
    file.add(0.75)
    file.add(UInt64(3))
    for (image, keypoint) in [(5, 1), (2, 0), (77, 0)] as [(UInt32, UInt32)] {
      file.add(image, keypoint)
    }
    return file.bytes
  }

  private static func folder() throws -> TemporaryFolder {
    let folder = try TemporaryFolder()
    try folder.write(cameras, as: "cameras.bin")
    try folder.write(images, as: "images.bin")
    try folder.write(points, as: "points3D.bin")
    return folder
  }

  @Test func allEntriesAreRead() throws {
    let folder = try Self.folder()
    let model = try #require(try COLMAPFolder.read(folder.url))
    #expect(model.cameras.map(\.width) == [100, 640])
    #expect(model.cameras[0].focalLength == [90, 90])
    #expect(model.cameras[0].distortion == [0.125, 0, 0, 0])
    #expect(model.cameras[1].focalLength == [500.5, 501])
    #expect(model.cameras[1].distortion == [-0.1, 0.01, 1e-4, -2e-4])
    #expect(model.photos.map(\.name) == ["sub/c.jpg", "a b.jpg"])
    #expect(model.photos.map(\.camera.index) == [0, 1])
    #expect(model.poses[1]?.translation == [1, 2, 5])
    let point = try #require(model.points.first)
    #expect(point.color == [10, 20, 30])
    #expect(point.error == 0.75)
    // Observations by photos that don't exist are dropped.
    #expect(point.track.map(\.photo.index) == [0, 1])
    #expect(point.track.map(\.pixel) == [[20, 0.5], [51, 0.5]])
  }

  @Test func fisheyeCamerasAreNamed() throws {
    let folder = try Self.folder()
    var cameras = Self.cameras
    cameras[12] = 5
    try folder.write(cameras, as: "cameras.bin")
    #expect {
      try COLMAPBinary.read(folder.url)
    } throws: {
      ($0 as? UnsupportedCameraModel)?.model == "OPENCV_FISHEYE"
    }
  }

  @Test(arguments: ["cameras.bin", "images.bin", "points3D.bin"])
  func damagedFilesGiveAValueOrAnError(_ name: String) throws {
    let folder = try Self.folder()
    let url = folder.url.appendingPathComponent(name)
    let whole = DamagedInput([UInt8](try Data(contentsOf: url)))
    var errors = 0
    let mutations = Array(whole.mutations(500, seed: 3, header: whole.bytes.count))
    for copy in Array(whole.truncations()) + mutations {
      try Data(copy).write(to: url)
      do {
        let model = try COLMAPBinary.read(folder.url)
        #expect(model.poses.count == model.photos.count)
        #expect(model.photos.allSatisfy { $0.camera.index < model.cameras.count })
      } catch is FormatError {
        errors += 1
      } catch is UnsupportedCameraModel {
        errors += 1
      }
    }
    #expect(errors > 100)
  }
}
