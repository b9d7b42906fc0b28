import Foundation
import SceneModel
import Testing

@Suite struct ReconstructionTests {
  private func reconstruction() -> Reconstruction {
    let cameras = [
      Camera(width: 100, height: 100, focalLength: [100, 100]),
      Camera(width: 200, height: 100, focalLength: [50, 50]),
    ]
    let photos = [1, 0, 1].enumerated().map { index, camera in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
        width: 100, height: 100, orientation: 1, camera: ID(camera))
    }
    return Reconstruction(
      cameras: cameras, photos: photos, poses: [.identity, nil, .identity], points: [])
  }

  @Test func registeredPhotosHaveAPose() {
    #expect(reconstruction().registered == [ID(0), ID(2)])
  }

  @Test func photosFindTheirCamera() {
    #expect(reconstruction().camera(of: ID(0)).width == 200)
    #expect(reconstruction().camera(of: ID(1)).width == 100)
  }

  @Test func errorsAreAveragedOverObservations() {
    var scene = reconstruction()
    #expect(scene.meanReprojectionError == 0)
    // The point is at (100, 50) in the photos of the second camera.
    scene.points = [
      ScenePoint(
        position: [0, 0, 2],
        track: [
          Observation(photo: ID(0), feature: 0, pixel: [103, 54]),
          Observation(photo: ID(1), feature: 0, pixel: [900, 900]),
          Observation(photo: ID(2), feature: 0, pixel: [100, 51]),
        ])
    ]
    // 5 and 1 pixels; the photo without a pose doesn't count.
    #expect(scene.meanReprojectionError == 3)
  }

  @Test func onlyArbitraryScaleIsNotMetric() {
    let scales: [WorldFrame.Scale] = [.depth, .gps, .knownDistance, .given, .arbitrary]
    #expect(scales.map(\.isMetric) == [true, true, true, true, false])
    #expect(WorldFrame() == WorldFrame(scale: .arbitrary, up: .unknown))
  }
}
