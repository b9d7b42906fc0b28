import SceneModel
import Testing

@Suite struct RasterImageTests {
  @Test func imagesAreFilled() {
    let image = RasterImage(width: 2, height: 3, channels: 4, filledWith: 7)
    #expect(image.pixels == [UInt8](repeating: 7, count: 24))
    #expect(RasterImage(width: 1, height: 1, channels: 1).pixels == [0])
  }

  @Test func missingPixelsStopTheProgram() async {
    await #expect(processExitsWith: .failure) {
      _ = RasterImage(width: 2, height: 2, channels: 1, pixels: [1, 2, 3])
    }
  }
}
