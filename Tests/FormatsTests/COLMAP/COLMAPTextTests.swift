import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

@Suite struct COLMAPTextTests {
  /// Three photos, the middle one without a pose, two cameras, two points.
  static let reconstruction: Reconstruction = {
    let cameras = [
      Camera(
        width: 4000, height: 3000, focalLength: [3000.1, 2999.9],
        principalPoint: [2001.5, 1499.25],
        distortion: [-0.1, 1.0 / 3, 1e-5, -2e-17], calibration: .refined),
      Camera(width: 640, height: 480, focalLength: [500, 500], calibration: .refined),
    ]
    let photos = ["a b.jpg", "c.jpg", "sub/d.jpg"].enumerated().map { index, name in
      Photo(
        id: ID(index), sampleID: index, name: name, url: URL(fileURLWithPath: "/" + name),
        width: 4000, height: 3000, orientation: 1, camera: ID(index / 2))
    }
    let pose = RigidTransform(
      rotation: Quaternion(angle: 0.7, axis: [1, 2, 3]), translation: [0.1, -1.0 / 3, 1e-9])
    func observation(_ photo: Int, _ feature: Int32) -> Observation {
      Observation(photo: ID(photo), feature: feature, pixel: [Double(feature) + 0.1, 2.0 / 3])
    }
    return Reconstruction(
      cameras: cameras, photos: photos, poses: [pose, nil, .identity],
      points: [
        ScenePoint(
          position: [1.0 / 3, 2, -3e-20], color: [1, 2, 255], error: 0.123456789012345678,
          track: [observation(0, 70), observation(2, 7)]),
        ScenePoint(position: [0, 1, 2], track: [observation(2, 3)]),
      ])
  }()

  @Test func roundTripIsExact() throws {
    try withTemporaryFolder { folder in
      let sparse = folder.appendingPathComponent("sparse")
      try COLMAPText.write(Self.reconstruction, to: sparse)
      let read = try COLMAPText.read(sparse, images: URL(fileURLWithPath: "/photos"))
      #expect(read.cameras == Self.reconstruction.cameras)
      #expect(read.photos.map(\.name) == ["a b.jpg", "sub/d.jpg"])
      #expect(read.photos.map(\.url.path) == ["/photos/a b.jpg", "/photos/sub/d.jpg"])
      #expect(read.photos.map(\.camera) == [ID(0), ID(1)])
      #expect(read.poses == [Self.reconstruction.poses[0], .identity])
      for (point, original) in zip(read.points, Self.reconstruction.points) {
        #expect(point.position == original.position)
        #expect(point.color == original.color)
        #expect(point.error == original.error)
      }
      #expect(read.points.count == 2)
      let pixels: [SIMD2<Double>] = [[70.1, 2.0 / 3], [7.1, 2.0 / 3]]
      #expect(read.points[0].track.map(\.pixel) == pixels)
      #expect(read.points[0].track.map(\.photo) == [ID(0), ID(1)])
      #expect(read.points[1].track.map(\.feature) == [1])
    }
  }

  @Test func fileHasCOLMAPsLayout() throws {
    let files = COLMAPText.encode(Self.reconstruction)
    #expect(files.map(\.name) == ["cameras.txt", "images.txt", "points3D.txt"])
    let lines = files.map {
      $0.text.split(separator: "\n", omittingEmptySubsequences: false).filter { $0.first != "#" }
    }
    #expect(lines[0][1] == "2 OPENCV 640 480 500.0 500.0 320.0 240.0 0.0 0.0 0.0 0.0")
    #expect(lines[1][2] == "3 1.0 0.0 0.0 0.0 0.0 0.0 0.0 2 sub/d.jpg")
    #expect(lines[1][3] == "7.1 0.6666666666666666 1 3.1 0.6666666666666666 2")
    #expect(lines[2][1] == "2 0.0 1.0 2.0 0 0 0 0.0 3 1")
  }

  @Test(arguments: [
    ("SIMPLE_PINHOLE", "100 50 40", [100, 100, 50, 40, 0, 0, 0, 0]),
    ("PINHOLE", "100 101 50 40", [100, 101, 50, 40, 0, 0, 0, 0]),
    ("SIMPLE_RADIAL", "100 50 40 0.1", [100, 100, 50, 40, 0.1, 0, 0, 0]),
    ("RADIAL", "100 50 40 0.1 0.2", [100, 100, 50, 40, 0.1, 0.2, 0, 0]),
    ("OPENCV", "100 101 50 40 1 2 3 4", [100, 101, 50, 40, 1, 2, 3, 4]),
    ("FULL_OPENCV", "100 101 50 40 1 2 3 4 0 0 0 0", [100, 101, 50, 40, 1, 2, 3, 4]),
  ])
  func everyCameraModelIsRead(_ model: String, _ parameters: String, _ expected: [Double]) throws {
    try withTemporaryFolder { folder in
      try write(folder, cameras: "7 \(model) 100 80 \(parameters)\n", images: "", points: "")
      let camera = try #require(try COLMAPText.read(folder).cameras.first)
      let (f, c, d) = (camera.focalLength, camera.principalPoint, camera.distortion)
      let parameters: [Double] = [f.x, f.y, c.x, c.y, d.x, d.y, d.z, d.w]
      #expect(parameters == expected)
    }
  }

  @Test(arguments: [
    ("1 LENS 10 10 1 2 3 4\n", "", ""), ("1 PINHOLE 10\n", "", ""),
    ("1 PINHOLE 10 10 1 2 x 4\n", "", ""), ("", "1 1 0 0 0 0 0 1 a.jpg\n", ""),
    ("", "1 1 0 0 0 0 0 0 1 a.jpg\n1 2\n", ""), ("", "", "1 2 3\n"),
    ("", "", "1 0 0 0 1 2 3 0.5 1\n"), ("", "", "1 0 nan 0 1 2 3 0.5 1 0\n"),
    ("1 PINHOLE 10 10 0 5 5 5\n", "", ""), ("1 FOV 10 10 5 5\n", "", ""),
  ])
  func damagedFilesAreErrors(_ cameras: String, _ images: String, _ points: String) throws {
    try withTemporaryFolder { folder in
      try write(folder, cameras: cameras, images: images, points: points)
      #expect(throws: FormatError.self) { try COLMAPText.read(folder) }
    }
  }

  @Test(arguments: [
    ("FULL_OPENCV", "100 101 50 40 1 2 3 4 0.1 0 0 0"), ("OPENCV_FISHEYE", "9 9 5 5 1 2 3 4"),
    ("FOV", "100 101 50 40 0.9"),
  ])
  func unsupportedCameraModelsAreReported(_ model: String, _ parameters: String) throws {
    try withTemporaryFolder { folder in
      try write(folder, cameras: "7 \(model) 100 80 \(parameters)\n", images: "", points: "")
      let path = folder.appendingPathComponent("cameras.txt").path
      #expect(throws: UnsupportedCameraModel(path: path, model: model)) {
        try COLMAPText.read(folder)
      }
    }
  }

  @Test func emptyLinesAndPointsAreOptional() throws {
    try withTemporaryFolder { folder in
      try write(
        folder, cameras: "1 PINHOLE 10 10 5 5 5 5\n",
        images: "1 1 0 0 0 0 0 0 1 a 1.jpg\n2 1 0 0 0 1 0 0 1 b.jpg\n\n3 1 0 0 0 2 0 0 1 c.jpg\n",
        points: "")
      try FileManager.default.removeItem(at: folder.appendingPathComponent("points3D.txt"))
      let read = try COLMAPText.read(folder)
      #expect(read.photos.map(\.name) == ["a 1.jpg", "b.jpg", "c.jpg"])
      #expect(read.poses.map { $0?.translation.x } == [0, 1, 2])
      #expect(read.points.isEmpty)
    }
  }

  /// The files of pycolmap 4.2.1: its lines of keypoints end with a blank, and that of a photo
  /// without keypoints is empty.
  @Test(arguments: ["", " ", "\t"]) func filesOfPycolmapAreRead(emptyLine: String) throws {
    try withTemporaryFolder { folder in
      try write(
        folder,
        cameras: """
          # Camera list with one line of data per camera:
          #   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]
          # Number of cameras: 1
          1 SIMPLE_RADIAL 640 480 500 320 240 0.10000000000000001

          """,
        images: """
          # Image list with two lines of data per image:
          #   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME
          #   POINTS2D[] as (X, Y, POINT3D_ID)
          # Number of images: 3, mean observations per image: 0.66666666666666663
          1 1 0 0 0.10000000000000001 0 0 1 1 view 1.jpg
          1.5 2.25 1 2.5 2.3500000000000001 -1 3.5 2.4500000000000002 -1 4.5 2.55 -1\u{20}
          2 1 0 0 0.20000000000000001 0 0 2 1 view 2.jpg
          \(emptyLine)
          3 1 0 0 0.30000000000000004 0 0 3 1 view 3.jpg
          4.5 2.25 -1 5.5 2.3500000000000001 -1 6.5 2.4500000000000002 -1 7.5 2.5 1\u{20}

          """,
        points: """
          # 3D point list with one line of data per point:
          #   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)
          # Number of points: 1, mean track length: 2
          1 0 0 5 1 2 3 -1 1 0 3 3

          """)
      try Data("# Rig calib list with one line of data per calib:\n1 1 CAMERA 1\n".utf8)
        .write(to: folder.appendingPathComponent("rigs.txt"))
      try Data("1 1 1 0 0 0.10000000000000001 0 0 1 1 CAMERA 1 1\n".utf8)
        .write(to: folder.appendingPathComponent("frames.txt"))
      let read = try COLMAPText.read(folder)
      #expect(read.photos.map(\.name) == ["view 1.jpg", "view 2.jpg", "view 3.jpg"])
      #expect(read.poses.map { $0?.translation.z } == [1, 2, 3])
      let pixels: [SIMD2<Double>] = [[1.5, 2.25], [7.5, 2.5]]
      #expect(read.points.count == 1 && read.points[0].track.map(\.pixel) == pixels)
      #expect(read.points[0].track.map(\.photo) == [ID(0), ID(2)])
    }
  }

  @Test func danglingReferencesAreDropped() throws {
    try withTemporaryFolder { folder in
      try write(
        folder, cameras: "1 SIMPLE_PINHOLE 10 10 5 5 5\n",
        images: "1 1 0 0 0 0 0 0 9 lost.jpg\n\n2 1 0 0 0 0 0 0 1 kept.jpg\n1 2 1\n",
        points: "1 0 0 1 1 2 3 0.5 2 0 2 5 1 0 77 0\n")
      let read = try COLMAPText.read(folder)
      #expect(read.photos.map(\.name) == ["kept.jpg"])
      #expect(read.points[0].track.map(\.pixel) == [SIMD2<Double>(1, 2)])
    }
  }

  private func write(
    _ folder: URL, cameras: String, images: String, points: String
  ) throws {
    for (name, text) in [("cameras", cameras), ("images", images), ("points3D", points)] {
      try Data(text.utf8).write(to: folder.appendingPathComponent("\(name).txt"))
    }
  }
}
