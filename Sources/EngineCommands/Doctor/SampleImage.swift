import Foundation
import ImageFiles
import Kernels
import SceneModel

/// A tiny image file, to test a decoder: orange on the left, blue on the right.
struct SampleImage {
  let format: ImageHeader.Format
  /// Width and height in pixels.
  let side: Int
  /// The content of the file; line breaks don't count.
  let base64: String

  /// Colors of the halves. Chosen.
  static let colors = (left: SIMD3<Int>(200, 80, 40), right: SIMD3<Int>(40, 80, 200))
  /// The largest permitted difference of a channel. Chosen: lossy compression changes the samples
  /// by less, and the two colors are 160 apart.
  static let tolerance = 24

  /// The content of the file.
  var content: [UInt8] {
    Data(base64Encoded: base64, options: .ignoreUnknownCharacters).map { [UInt8]($0) } ?? []
  }

  /// Whether the program was built without a decoder for the format.
  var isLeftOut: Bool {
    do {
      _ = try ImageHeader(content)
      return false
    } catch {
      guard case .decoderLeftOut = error else { return false }
      return true
    }
  }

  /// Decodes the image; returns why it failed, nil if size and colors are right.
  func failure(of content: [UInt8]? = nil) -> String? {
    let image: RasterImage
    do {
      image = try ImageCodec.decode(content ?? self.content)
    } catch {
      return error.localizedDescription
    }
    guard (image.width, image.height, image.channels) == (side, side, 3) else {
      return "the size is wrong"
    }
    let row = side / 2
    func color(_ column: Int) -> SIMD3<Int> {
      let first = (row * side + column) * 3
      return SIMD3(
        Int(image.pixels[first]), Int(image.pixels[first + 1]), Int(image.pixels[first + 2]))
    }
    func isNear(_ a: SIMD3<Int>, _ b: SIMD3<Int>) -> Bool {
      (0..<3).allSatisfy { abs(a[$0] - b[$0]) <= Self.tolerance }
    }
    let isRight =
      isNear(color(side / 4), Self.colors.left)
      && isNear(color(side * 3 / 4), Self.colors.right)
    return isRight ? nil : "the colors are wrong"
  }
}
