import Foundation
import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct CameraFitTests {
  private let camera = Camera(
    width: 400, height: 300, focalLength: [500, 480], principalPoint: [190, 160],
    distortion: [-0.1, 0.02, 0.003, -0.004], calibration: .refined)

  private func photo(_ width: Int, _ height: Int, orientation: Int = 1) -> Photo {
    Photo(
      id: ID(0), sampleID: 0, name: "a.jpg", url: URL(fileURLWithPath: "/a.jpg"), width: width,
      height: height, orientation: orientation, camera: ID(0))
  }

  @Test func cameraOfTheSameSizeIsUnchanged() throws {
    let fit = try #require(CameraFit(camera, to: photo(400, 300), isSizeKnown: true))
    let pose = RigidTransform(
      rotation: Quaternion(angle: 0.3, axis: [1, 2, 3]), translation: [1.0 / 3, 2, 3])
    #expect(fit.camera == camera)
    #expect(fit.pose(pose) == pose)
    #expect(fit.pixel([12.5, 1.0 / 3]) == [12.5, 1.0 / 3])
    #expect(!fit.isScaled && fit.quarterTurns == 0)
  }

  /// A point projects to the same position in the picture regardless of the orientation of the
  /// photo.
  @Test(arguments: [(6, 300, 400), (8, 300, 400), (6, 150, 200), (1, 200, 150), (1, 1200, 900)])
  func pointsKeepTheirPositionInThePicture(_ orientation: Int, _ width: Int, _ height: Int) throws {
    let fit = try #require(
      CameraFit(camera, to: photo(width, height, orientation: orientation), isSizeKnown: true))
    let pose = RigidTransform(
      rotation: Quaternion(angle: 0.2, axis: [1, -1, 0.5]), translation: [0.1, -0.2, 3])
    for point: SIMD3<Double> in [[0, 0, 0], [0.5, 0.3, 0.2], [-0.4, 0.6, -0.5]] {
      let expected = fit.pixel(camera.project(pose * point))
      let found = fit.camera.project(fit.pose(pose) * point)
      #expect((found - expected).length < 1e-9)
    }
    #expect((fit.pose(pose).center - pose.center).length < 1e-12)
  }

  /// The pixel of the only bright spot is the same in the upright photo.
  @Test(arguments: [6, 8]) func pixelsRotateLikePhotos(_ orientation: Int) throws {
    var image = RasterImage(width: 400, height: 300, channels: 1)
    image.pixels[70 * 400 + 310] = 255
    let upright = try image.turned(byOrientation: orientation)
    let place = try #require(upright.pixels.firstIndex(of: 255))
    let fit = try #require(
      CameraFit(camera, to: photo(300, 400, orientation: orientation), isSizeKnown: true))
    let expected = SIMD2(Double(place % 300) + 0.5, Double(place / 300) + 0.5)
    #expect((fit.pixel([310.5, 70.5]) - expected).length < 1e-9)
  }

  /// Cameras of damaged files; photos without a possible camera are left out.
  @Test(
    arguments: [
      ([1e-300, 480], [190, 1e10]), ([500, 480], [1e300, 160]), ([1e300, 480], [190, 160]),
    ]
      as [(SIMD2<Double>, SIMD2<Double>)], [true, false])
  func impossibleCamerasAreLeftOut(
    _ intrinsics: (focal: SIMD2<Double>, center: SIMD2<Double>), isSizeKnown: Bool
  ) throws {
    var camera = camera
    (camera.focalLength, camera.principalPoint) = intrinsics
    let photos = (0..<4).map { index in
      var photo = photo(400, 300)
      (photo.id, photo.sampleID, photo.name) = (ID(index), index, "\(index).jpg")
      return photo
    }
    var known = Reconstruction(
      cameras: [self.camera], photos: photos, poses: photos.map { _ in .identity }, points: [])
    known.cameras.append(camera)
    known.photos[3].camera = ID(1)
    let ingested = IngestedPhotos(
      photos: photos, cameras: [self.camera], rejected: [], files: photos.map(\.url),
      rejectedMasks: [], contentHashes: [0, 1, 2, 3], processingPixels: 120_000,
      isDownsampled: false)
    let result = try CameraAssignment().run(
      KnownCameras(known, photosOfUnknownSize: isSizeKnown ? [] : [ID(3)]), to: ingested,
      StageContext())
    #expect(result.reconstruction.registered == [ID(0), ID(1), ID(2)])
    let reasons = result.reconstruction.unregistered.map(\.reason)
    #expect(reasons.count == 1 && reasons[0].contains("principal point"), "\(reasons)")
  }

  @Test func sizesMayBeRounded() throws {
    // 400 × 300 reduced to a width of 255 is 191.25 high.
    for height in [191, 192] {
      let fit = try #require(CameraFit(camera, to: photo(255, height), isSizeKnown: true))
      #expect(fit.camera.width == 255 && fit.camera.height == height && fit.isScaled)
      #expect(abs(fit.camera.focalLength.x - 500 * 255 / 400) < 1)
      #expect((fit.pixel([400, 300]) - [255, Double(height)]).length < 1)
    }
    #expect(CameraFit(camera, to: photo(255, 195), isSizeKnown: true) == nil)
  }

  @Test(arguments: [(400, 311), (300, 400), (410, 300)])
  func otherAspectRatiosAreRejected(_ width: Int, _ height: Int) {
    #expect(CameraFit(camera, to: photo(width, height), isSizeKnown: true) == nil)
  }

  @Test func cameraWithoutSizeTakesThePhotoSize() throws {
    let fit = try #require(CameraFit(camera, to: photo(404, 297), isSizeKnown: false))
    #expect(fit.camera.width == 404 && fit.camera.height == 297)
    #expect(fit.camera.focalLength == camera.focalLength)
    let turned = try #require(
      CameraFit(camera, to: photo(300, 400, orientation: 8), isSizeKnown: false))
    #expect(turned.quarterTurns == 3)
    #expect(turned.camera.width == 300 && turned.camera.principalPoint == [160, 210])
    #expect(CameraFit(camera, to: photo(200, 150), isSizeKnown: false) == nil)
    #expect(CameraFit(camera, to: photo(1000, 750), isSizeKnown: false) == nil)
  }
}
