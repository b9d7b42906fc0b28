import Foundation
import SceneModel
import Testing

@Suite struct ReconstructionResidualsTests {
  @Test func residualsAreThoseOfEachPhoto() {
    let camera = Camera(
      width: 100, height: 100, focalLength: SIMD2(100, 100), calibration: .exif)
    let photos = (0..<3).map {
      Photo(
        id: ID($0), sampleID: $0, name: "\($0).jpg", url: URL(filePath: "/\($0).jpg"), width: 100,
        height: 100, orientation: 1, camera: ID(0))
    }
    // The point is seen in the middle of photos 0 and 1, and measured 3 and 4 pixels away.
    let reconstruction = Reconstruction(
      cameras: [camera], photos: photos, poses: [.identity, .identity, nil],
      points: [
        ScenePoint(
          position: [0, 0, 2], color: .zero,
          track: [
            Observation(photo: ID(0), feature: 0, pixel: [53, 54]),
            Observation(photo: ID(1), feature: 0, pixel: [50, 50]),
            Observation(photo: ID(2), feature: 0, pixel: [0, 0]),
          ])
      ])
    #expect(reconstruction.residuals.map { $0.map(\.pixel) } == [[[53, 54]], [[50, 50]], []])
    #expect(reconstruction.residuals.map { $0.map(\.offset) } == [[[-3, -4]], [[0, 0]], []])
    #expect(reconstruction.meanReprojectionError == 2.5)
  }
}
