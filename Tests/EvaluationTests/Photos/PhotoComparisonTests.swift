import Foundation
import Formats
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Evaluation

@Suite struct PhotoComparisonTests {
  /// A textured unit square at depth 1 that fills the left half of a photo of 40 × 20 pixels.
  private static func model() throws -> LoadedModel {
    var part = LoadedModel.Part()
    part.positions = [[-1, -0.5, 1], [0, -0.5, 1], [0, 0.5, 1], [-1, 0.5, 1]]
    part.textureCoordinates = [[0, 1], [1, 1], [1, 0], [0, 0]]
    part.triangles = [Triangle(0, 2, 1), Triangle(0, 3, 2)]
    part.baseColor = EncodedImage(
      fileExtension: "png", bytes: try ImageCodec.encodePNG(texture))
    return LoadedModel(parts: [part])
  }

  private static var texture: RasterImage {
    var image = RasterImage(width: 20, height: 20, channels: 3)
    for index in image.pixels.indices { image.pixels[index] = UInt8((index * 37) % 200 + 20) }
    return image
  }

  private static let camera = NamedCamera(
    name: "photo.png", camera: Camera(width: 40, height: 20, focalLength: [20, 20]),
    cameraFromWorld: .identity)

  /// The photo that the camera takes, with the texture's values multiplied.
  private static func photo(gain: Float = 1) -> RasterImage {
    var image = RasterImage(width: 40, height: 20, channels: 3, filledWith: 255)
    for row in 0..<20 {
      for column in 0..<60 {
        image.pixels[row * 120 + column] = UInt8(Float(texture.pixels[row * 60 + column]) * gain)
      }
    }
    return image
  }

  private func scores(
    _ photo: RasterImage, mask: RasterImage?, camera: NamedCamera = camera
  ) throws -> PhotoScoreSummary {
    let folder = try TemporaryFolder()
    try folder.write(try ImageCodec.encodePNG(photo), as: "photo.png")
    if let mask { try folder.write(try ImageCodec.encodePNG(mask), as: "photo_mask.png") }
    let photos = HeldOutPhoto.photos(in: folder.url, [camera])
    #expect(photos.count == 1)
    let control = KernelControl(threadCount: 2)
    let model = try ShadedModel(try Self.model(), .identity, control)
    return try #require(try PhotoComparison(control).run(model, photos))
  }

  private static var leftHalf: RasterImage {
    var mask = RasterImage(width: 40, height: 20, channels: 1)
    for index in mask.pixels.indices where index % 40 < 20 { mask.pixels[index] = 255 }
    return mask
  }

  @Test func theExactModelIsRecognizedInsideOfItsMask() throws {
    let summary = try scores(Self.photo(), mask: Self.leftHalf)
    #expect(summary.psnr > 60)
    #expect(summary.ssim > 0.999)
    #expect(summary.photos.map(\.missing) == [0])
  }

  @Test func exposureIsNotTheModelsFault() throws {
    #expect(try scores(Self.photo(gain: 0.5), mask: Self.leftHalf).psnr > 45)
  }

  @Test func missingSurfaceIsGray() throws {
    let summary = try scores(Self.photo(), mask: nil)
    #expect(summary.psnr < 20)
    #expect(summary.photos.map(\.missing) == [0.5])
  }

  /// PSNR is that of the formula: half of the pixels differ by 0.1, which no gain explains.
  @Test func theErrorIsThatOfTheFormula() throws {
    var photo = Self.photo()
    for row in 0..<20 {
      for column in 0..<20 where (row + column) % 2 == 0 {
        for channel in 0..<3 { photo.pixels[row * 120 + column * 3 + channel] += 25 }
      }
    }
    let found = try scores(photo, mask: Self.leftHalf).psnr
    let largest = 10 * log10(1 / (0.5 * pow(25.0 / 255, 2)))
    #expect(found > largest && found < largest + 3)
  }

  @Test func photosWithAnEmptyMaskDontCount() throws {
    let folder = try TemporaryFolder()
    try folder.write(try ImageCodec.encodePNG(Self.photo()), as: "photo.png")
    let mask = RasterImage(width: 40, height: 20, channels: 1)
    try folder.write(try ImageCodec.encodePNG(mask), as: "photo_mask.png")
    let control = KernelControl(threadCount: 1)
    let model = try ShadedModel(try Self.model(), .identity, control)
    let photos = HeldOutPhoto.photos(in: folder.url, [Self.camera])
    #expect(try PhotoComparison(control).run(model, photos) == nil)
  }

  @Test func theMaskOfAPhotoIsNoPhoto() throws {
    let folder = try TemporaryFolder()
    try folder.write(try ImageCodec.encodePNG(Self.leftHalf), as: "photo_mask.png")
    #expect(HeldOutPhoto.photos(in: folder.url, [Self.camera]).isEmpty)
  }
}
