import Foundation
import SceneModel
import Testing

@Suite struct CameraTests {
  @Test func pinholesProjectByTheFormula() {
    let camera = Camera(
      width: 640, height: 480, focalLength: [500, 600], principalPoint: [300, 250])
    #expect(camera.project([1, 2, 4]) == [425, 550])
    #expect(camera.unproject([425, 550]) == [0.25, 0.5])
    #expect(camera.distort([0.3, -0.4]) == [0.3, -0.4])
  }

  @Test func thePrincipalPointIsTheCenterUnlessGiven() {
    let camera = Camera(width: 641, height: 480, focalLength: [500, 500])
    #expect(camera.principalPoint == [320.5, 240] && camera.calibration == .assumed)
  }

  /// The terms of OpenCV's documentation, one at a time at (0.5, −0.25), where r² is 0.3125.
  private static let distortions: [(SIMD4<Double>, SIMD2<Double>)] = [
    (SIMD4(1, 0, 0, 0), SIMD2(0.65625, -0.328125)),
    (SIMD4(0, 1, 0, 0), SIMD2(0.548828125, -0.2744140625)),
    (SIMD4(0, 0, 1, 0), SIMD2(0.25, 0.1875)),
    (SIMD4(0, 0, 0, 1), SIMD2(1.3125, -0.5)),
  ]

  @Test func distortionIsThatOfOpenCV() {
    for (coefficients, expected) in Self.distortions {
      let camera = Camera(
        width: 2, height: 2, focalLength: [1, 1], principalPoint: [0, 0],
        distortion: coefficients)
      #expect((camera.distort([0.5, -0.25]) - expected).length < 1e-15)
      #expect((camera.project([1, -0.5, 2]) - expected).length < 1e-15)
    }
  }

  @Test func unprojectionInvertsRandomCameras() {
    var random = SplitMix64(seed: 20)
    for _ in 0..<50 {
      let camera = Camera(
        width: 1000, height: 800, focalLength: [900 + random.number(50), 900 + random.number(50)],
        principalPoint: [500 + random.number(20), 400 + random.number(20)],
        distortion: [
          random.number(0.1), random.number(0.02), random.number(0.002), random.number(0.002),
        ])
      for _ in 0..<20 {
        let pixel = SIMD2(1000 * random.uniform(), 800 * random.uniform())
        let ray = camera.unproject(pixel)
        #expect((camera.project([ray.x, ray.y, 1]) - pixel).length < 1e-8)
        #expect((camera.project([3 * ray.x, 3 * ray.y, 3]) - pixel).length < 1e-8)
      }
    }
  }

  @Test func resizingScalesAxesIndependently() {
    let camera = Camera(
      width: 1000, height: 800, focalLength: [900, 905], principalPoint: [480, 410],
      distortion: [0.1, 0, 0, 0], calibration: .exif)
    let small = camera.resized(width: 100, height: 400)
    #expect(small.width == 100 && small.height == 400)
    #expect((small.focalLength - [90, 452.5]).length < 1e-12)
    #expect((small.principalPoint - [48, 205]).length < 1e-12)
    #expect(small.distortion == camera.distortion && small.calibration == .exif)
    let point = SIMD3(0.1, 0.2, 1.5)
    #expect((small.project(point) * [10, 2] - camera.project(point)).length < 1e-9)
  }
}
