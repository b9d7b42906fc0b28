import BitmapGraphics
import Testing

@Suite struct CGColorTests {
  @Test func componentsEndWithTheOpacity() {
    let gray = CGColor(gray: 0.25, alpha: 0.5)
    #expect(gray.components == [0.25, 0.5] && gray.alpha == 0.5)
    #expect(gray.colorSpace?.model == .monochrome)
    let color = CGColor(srgbRed: 0.1, green: 0.2, blue: 0.3, alpha: 0.4)
    #expect(color.components == [0.1, 0.2, 0.3, 0.4] && color.alpha == 0.4)
    #expect(color.colorSpace?.numberOfComponents == 3)
  }

  @Test func equalComponentsAreEqualColors() {
    #expect(CGColor.black == CGColor(gray: 0, alpha: 1) && CGColor.black != .clear)
    #expect(CGColor.white != CGColor(red: 1, green: 1, blue: 1, alpha: 1))
    #expect(Set([CGColor.black, .white, CGColor(gray: 1, alpha: 1)]).count == 2)
  }

  @Test(
    arguments: [
      (CGColorSpace.sRGB, CGColorSpaceModel.rgb, 3), (CGColorSpace.displayP3, .rgb, 3),
      (CGColorSpace.genericGrayGamma2_2, .monochrome, 1), (CGColorSpace.linearGray, .monochrome, 1),
    ] as [(String, CGColorSpaceModel, Int)]) func namedSpacesHaveTheirModel(
      name: String, model: CGColorSpaceModel, count: Int
    ) throws
  {
    let space = try #require(CGColorSpace(name: name))
    #expect(space.model == model && space.numberOfComponents == count && space.name == name)
    #expect(CGColorSpace(name: name) == space)
  }

  @Test func deviceSpacesHaveNoName() {
    #expect(CGColorSpaceCreateDeviceRGB().name == nil)
    #expect(CGColorSpaceCreateDeviceRGB() == CGColorSpaceCreateDeviceRGB())
    #expect(CGColorSpaceCreateDeviceRGB() != CGColorSpaceCreateDeviceGray())
    #expect(CGColorSpace(name: CGColorSpace.sRGB) != CGColorSpaceCreateDeviceRGB())
    #expect(CGColorSpace(name: "kCGColorSpaceUnknown") == nil)
  }

  @Test func bitsAreThoseOfApple() {
    #expect(CGBitmapInfo.byteOrder32Little.rawValue == 8192)
    #expect(CGBitmapInfo.byteOrder32Big.rawValue == 16384)
    #expect(CGBitmapInfo.alphaInfoMask.rawValue == 31)
    #expect(CGImageAlphaInfo.premultipliedFirst.rawValue == 2)
    #expect(CGImageAlphaInfo.noneSkipFirst.rawValue == 6)
    #expect(CGImageAlphaInfo.alphaOnly.rawValue == 7)
    #expect(CGInterpolationQuality.none.rawValue == 1)
    #expect(CGColorSpaceModel.monochrome.rawValue == 0 && CGColorSpaceModel.rgb.rawValue == 1)
  }
}
