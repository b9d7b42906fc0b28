import ImageFiles
import Testing

@testable import EngineCommands

@Suite struct SampleImageTests {
  @Test func everyFormatHasASample() {
    #expect(Set(SampleImage.all.map(\.format)) == Set(ImageHeader.Format.allCases))
    #expect(SampleImage.all.count == ImageHeader.Format.allCases.count)
  }

  @Test func samplesAreDecoded() throws {
    for sample in SampleImage.all {
      #expect(sample.failure() == nil, "\(sample.format)")
      #expect(try ImageHeader(sample.content).format == sample.format)
      #expect(sample.content.count < 1000)
    }
  }

  /// A decoder that returns something else must be noticed.
  @Test func otherContentFails() throws {
    for sample in SampleImage.all {
      #expect(sample.failure(of: []) != nil)
      #expect(sample.failure(of: Array(sample.content.prefix(30))) != nil)
    }
    let bmp = try #require(SampleImage.all.first { $0.format == .bmp })
    let black = Array(bmp.content.prefix(54)) + [UInt8](repeating: 0, count: 192)
    #expect(bmp.failure(of: black) == "the colors are wrong")
    let png = try #require(SampleImage.all.first { $0.format == .png })
    #expect(bmp.failure(of: png.content) == "the size is wrong")
  }
}
