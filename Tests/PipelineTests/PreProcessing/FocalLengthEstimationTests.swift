import ImageFiles
import SceneModel
import Testing

@testable import Pipeline

@Suite struct FocalLengthEstimationTests {
  @Test func focalLengthComesFromTheBestSource() {
    let estimation = FocalLengthEstimation()
    func pixels(_ change: (inout PhotoMetadata) -> Void) -> (Double, Camera.Calibration) {
      var metadata = PhotoMetadata()
      change(&metadata)
      return estimation.run(metadata, width: 1200, height: 1600)
    }
    let equivalent = pixels { $0.focalLengthIn35mmFilm = 27 }
    #expect(equivalent == (1200, .exif))
    // A full-frame camera, whose actual focal length is more accurate.
    let fullFrame = pixels {
      $0.focalLengthIn35mmFilm = 41
      $0.focalLength = 41.4
    }
    #expect(abs(fullFrame.0 - 1840) < 1e-9)
    // 4000 pixels were 8 mm; the photo was later resized to 1600.
    let sensor = pixels {
      $0.focalLength = 10
      $0.focalPlaneResolution = 500
      $0.originalWidth = 4000
      $0.originalHeight = 3000
    }
    #expect(sensor == (2000, .exif))
    let tinySensor = pixels {
      $0.focalLength = 50
      $0.focalPlaneResolution = 1e8
    }
    #expect(tinySensor == (1920, .assumed))
    #expect(pixels { _ in } == (1920, .assumed))
  }
}
