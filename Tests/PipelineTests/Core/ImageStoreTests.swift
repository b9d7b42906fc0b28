import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ImageStoreTests {
  private let distorted = Camera(
    width: 400, height: 300, focalLength: [330, 332], principalPoint: [205, 148])

  private func reconstruction(_ camera: Camera) -> Reconstruction {
    let photo = Photo(
      id: ID(0), sampleID: 0, name: "a", url: .init(filePath: "/a"), width: camera.width,
      height: camera.height, orientation: 1, camera: ID(0))
    return Reconstruction(cameras: [camera], photos: [photo], poses: [.identity], points: [])
  }

  @Test func sizesKeepTheAspectAndTheBound() {
    for pixels in [1, 1000, 99_999, 120_000, 1_000_000] {
      let size = ImageStore.size(width: 400, height: 300, maximumPixels: pixels)
      #expect(size.width * size.height <= max(1, pixels))
      #expect(size.width <= 400)
    }
    #expect(ImageStore.size(width: 400, height: 300, maximumPixels: 30_000) == (200, 150))
  }

  @Test func memoryBudgetDoesNotChangeImages() throws {
    let folder = try TemporaryFolder()
    for index in 0..<4 {
      try folder.write(
        ImageCodec.encodeJPEG(
          TexturePattern.image(width: 400, height: 300, seed: UInt32(index)), quality: 0.9),
        as: "\(index).jpg")
    }
    let photos = try PhotoIngestion().run(folder: folder.url, StageContext()).photos
    let stores = [0, 800_000, 1 << 30].map { ImageStore(photos: photos, byteBudget: $0) }
    for index in [0, 1, 2, 0, 3, 1] {
      for pixels in [nil, 50_000] {
        let images = try stores.map { try $0.image(ID(index), maximumPixels: pixels) }
        #expect(images[0] == images[1])
        #expect(images[0] == images[2])
      }
    }
    #expect(throws: KernelError.self) { try stores[0].image(ID(4)) }
  }

  /// Each photo is decoded once for all sizes, while they fit into the budget at full size.
  @Test func photosAreDecodedOnceWithinTheBudget() throws {
    let photos = (0..<3).map { TexturePattern.image(width: 405, height: 300, seed: $0) }
    let all = photos.reduce(0) { $0 + $1.pixels.count }
    for (budget, decodes) in [(all, 3), (all - 1, 6)] {
      let store = ImageStore(ImagesInMemory(images: photos), byteBudget: budget)
      for maximumPixels in [50_000, 90_000] {
        for (index, photo) in photos.enumerated() {
          let image = try store.image(ID(index), maximumPixels: maximumPixels)
          #expect(try image == photo.reduced(to: maximumPixels))
        }
      }
      #expect(store.decodeCount == decodes)
    }
  }

  /// Reads JPEG photos in two sizes, as the texture stage does, of which the smaller alone would be
  /// decoded at half size.
  @Test func aStageDecodesAPhotoOnceForAllSizes() throws {
    let folder = try TemporaryFolder()
    for index in 0..<3 {
      try folder.write(
        ImageCodec.encodeJPEG(
          TexturePattern.image(width: 400, height: 300, seed: UInt32(index)), quality: 0.9),
        as: "\(index).jpg")
    }
    let photos = try PhotoIngestion().run(folder: folder.url, StageContext()).photos
    let bytes = photos.count * 400 * 300 * 3
    for (budget, decodes) in [(bytes, 3), (2 * bytes / 3, 4), (0, 6)] {
      let whole = ImageStore(photos: photos, byteBudget: budget)
      _ = try whole.image(ID(0), maximumPixels: 25_000)
      whole.startStage()
      let before = whole.decodeCount
      let store = whole.decodingOnce(forSizesUpTo: 90_000)
      for pixels in [25_000, 90_000] {
        for photo in photos {
          let full = try ImageCodec.decode(ImageCodec.contents(of: photo.url))
          #expect(try store.image(photo.id, maximumPixels: pixels) == full.reduced(to: pixels))
        }
      }
      #expect(store.decodeCount - before == decodes)
    }
  }

  /// Of six photos that are read three times, the cache holds four: only two are decoded again.
  @Test func repeatedScansDisplaceOnlyImagesOfEarlierStages() throws {
    let photos = (0..<6).map { TexturePattern.image(width: 400, height: 300, seed: $0) }
    let store = ImageStore(ImagesInMemory(images: photos), byteBudget: 4 * photos[0].pixels.count)
    for stage in 0..<2 {
      store.startStage()
      let before = store.decodeCount
      let order = stage == 0 ? Array(photos.indices) : photos.indices.reversed()
      for _ in 0..<3 {
        for index in order { #expect(try store.image(ID(index)) == photos[index]) }
      }
      #expect(store.decodeCount - before == (stage == 0 ? 6 : 4) + 2 * 2)
    }
  }

  @Test func aStoreWithOtherMasksSharesDecodedPhotos() throws {
    let folder = try TemporaryFolder()
    try folder.write(
      ImageCodec.encodeJPEG(TexturePattern.image(width: 400, height: 300, seed: 1), quality: 0.9),
      as: "a.jpg")
    var photos = try PhotoIngestion().run(folder: folder.url, StageContext()).photos
    let store = ImageStore(photos: photos)
    _ = try store.image(ID(0))
    let marked = RasterImage(width: 200, height: 150, channels: 1).marking { _ in true }
    let file = try folder.write(ImageCodec.encodePNG(marked), as: "mask.png")
    photos[0].mask = PhotoMask(file: file, orientation: 1, contentHash: 1, coverage: 1)
    let masked = ImageStore(masked: photos, contentHashes: [], sharing: store)
    #expect(try masked.image(ID(0)) == store.image(ID(0)))
    #expect(masked.decodeCount == 1)
    #expect(try store.mask(ID(0)) == nil && masked.mask(ID(0), maximumPixels: 30_000) == marked)
    #expect(try masked.fingerprint(of: ID(0)) != store.fingerprint(of: ID(0)))

    // Other masks of the same photos are not mistaken for the cached ones.
    let hidden = RasterImage(width: 200, height: 150, channels: 1)
    let other = try folder.write(ImageCodec.encodePNG(hidden), as: "other.png")
    photos[0].mask = PhotoMask(file: other, orientation: 1, contentHash: 2, coverage: 0.5)
    let remasked = ImageStore(masked: photos, contentHashes: [], sharing: store)
    #expect(try remasked.mask(ID(0), maximumPixels: 30_000) == hidden)
    #expect(try remasked.image(ID(0)) == store.image(ID(0)) && remasked.decodeCount == 1)
  }

  @Test func aStoreWithoutMasksSharesDecodedPhotos() throws {
    let image = TexturePattern.image(width: 400, height: 300, seed: 1)
    let mask = RasterImage(width: 400, height: 300, channels: 1)
    let store = ImageStore(ImagesInMemory(images: [image], masks: [mask]))
    let whole = ImageStore(withoutMasksOf: store)
    #expect(try store.hasMasks && store.mask(ID(0)) == mask)
    #expect(try !whole.hasMasks && whole.mask(ID(0)) == nil)
    #expect(try store.image(ID(0)) == whole.image(ID(0)))
    #expect(whole.decodeCount == 1)
  }

  @Test func changedFilesAreReported() throws {
    let folder = try TemporaryFolder()
    try folder.write(
      ImageCodec.encodeJPEG(TexturePattern.image(width: 400, height: 300, seed: 0), quality: 0.9),
      as: "a.jpg")
    let store = ImageStore(
      photos: try PhotoIngestion().run(folder: folder.url, StageContext()).photos)
    try folder.write([0xFF, 0xD8, 0xFF], as: "a.jpg")
    let error = #expect(throws: PhotoReadError.self) { try store.image(ID(0)) }
    #expect(error?.errorDescription?.hasPrefix("a.jpg can't be used: ") == true)
  }

  @Test(arguments: [
    SIMD4<Double>(-0.3, 0.1, 0, 0), [0.25, -0.05, 0, 0], [-0.1, 0, 0.003, -0.004],
    [-0.6, 0, 0, 0], [2, -4, 0.1, 0.1],
  ])
  func everyPinholePixelHasASourcePixel(distortion: SIMD4<Double>) throws {
    var camera = distorted
    camera.distortion = distortion
    let pinhole = camera.undistortedPinhole(maximumPixels: 1_000_000)
    #expect(pinhole.width > 100)
    #expect(pinhole.height > 75)
    for x in stride(from: 0.5, to: Double(pinhole.width), by: 1) {
      for y in [0.5, Double(pinhole.height) - 0.5] {
        let ray = pinhole.unproject([x, y])
        let source = camera.project([ray.x, ray.y, 1])
        #expect(source.x >= 0 && source.y >= 0 && source.x <= 400 && source.y <= 300)
      }
    }
    #expect(camera.undistortedPinhole(maximumPixels: 10_000).width <= 140)
  }

  @Test func pinholeViewsAreUndistortedCorrectly() throws {
    var camera = distorted
    camera.distortion = [-0.2, 0.05, 0.001, 0]
    // Red encodes the column: it identifies the source of each pixel of the view.
    var image = RasterImage(width: 400, height: 300, channels: 3)
    for index in 0..<(400 * 300) { image.pixels[3 * index] = UInt8(index % 400 / 2) }
    let view = try ImageStore(images: [image]).pinholeView(
      ID(0), of: reconstruction(camera), maximumPixels: 60_000)
    #expect(view.image.width == view.camera.width)
    #expect(view.camera.distortion == .zero)
    let full = camera.resized(width: 400, height: 300)
    for (x, y) in [(30, 20), (140, 100), (200, 60), (100, 150)] {
      let ray = view.camera.unproject([Double(x) + 0.5, Double(y) + 0.5])
      let source = full.project([ray.x, ray.y, 1])
      let red = Double(view.image.pixels[(y * view.image.width + x) * 3])
      #expect(abs(red - (source.x - 0.5) / 2) < 1)
    }
  }

  @Test func unregisteredPhotosHaveNoView() {
    var scene = reconstruction(distorted)
    scene.poses = [nil]
    let store = ImageStore(images: [RasterImage(width: 400, height: 300, channels: 3)])
    #expect(throws: KernelError.self) {
      try store.pinholeView(ID(0), of: scene, maximumPixels: 1000)
    }
  }

  /// Orientation 6 rotates by 90 degrees, 405 is not divisible by two, and 800 / 250 is between a
  /// quarter and a half.
  @Test(arguments: [(800, 600, 1), (800, 600, 6), (405, 300, 1), (803, 601, 1)])
  func scaledJPEGDecodingMatchesReduction(
    width: Int, height: Int, orientation: Int
  ) throws {
    let folder = try TemporaryFolder()
    let bytes = try ImageCodec.encodeJPEG(
      TexturePattern.image(width: width, height: height, seed: 3), quality: 0.95)
    let url = try folder.write(bytes, as: "a.jpg")
    let whole = try ImageCodec.decode(bytes).turned(byOrientation: orientation)
    let photo = Photo(
      id: ID(0), sampleID: 0, name: "a.jpg", url: url, width: whole.width, height: whole.height,
      orientation: orientation, camera: ID(0))
    for pixels in [250_000, 100_000, 40_000, 9000] {
      let small = try ImageStore(photos: [photo]).image(ID(0), maximumPixels: pixels)
      let expected = try whole.reduced(to: pixels)
      #expect(small.width == expected.width)
      #expect(small.height == expected.height)
      let differences = zip(small.pixels, expected.pixels).map { abs(Int($0) - Int($1)) }
      #expect(differences.reduce(0, +) < differences.count)
      #expect(differences.max() ?? 0 < 20)
    }
  }

  @Test func fingerprintsFollowContentAndSize() throws {
    let folder = try TemporaryFolder()
    let images = (0..<2).map { TexturePattern.image(width: 400, height: 300, seed: $0) }
    for (index, image) in images.enumerated() {
      try folder.write(ImageCodec.encodeJPEG(image, quality: 0.9), as: "\(index).jpg")
    }
    let ingested = try PhotoIngestion().run(folder: folder.url, StageContext())
    let stores = [[], ingested.contentHashes].map {
      ImageStore(photos: ingested.photos, contentHashes: $0)
    }
    for store in stores {
      #expect(try store.fingerprint(of: ID(0)) == store.fingerprint(of: ID(0)))
      #expect(try store.fingerprint(of: ID(0)) != store.fingerprint(of: ID(1)))
    }
    let reduced = ImageStore(photos: ingested.photos, processingPixels: 50_000)
    #expect(try reduced.fingerprint(of: ID(0)) != stores[0].fingerprint(of: ID(0)))
    let before = try stores[0].fingerprint(of: ID(0))
    try folder.write(ImageCodec.encodeJPEG(images[0], quality: 0.8), as: "0.jpg")
    #expect(try stores[0].fingerprint(of: ID(0)) != before)
  }
}
