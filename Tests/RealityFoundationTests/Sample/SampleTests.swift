import Foundation
import ImageFiles
import Kernels
import Pipeline
import SceneModel
import TestSupport
import Testing

@testable import RealityFoundation

@Suite struct SampleTests {
  /// An RGB image with distinct pixels.
  static let image = RasterImage(
    width: 37, height: 20, channels: 3,
    pixels: (0..<37 * 20 * 3).map { UInt8(truncatingIfNeeded: $0 &* 7) })

  private func sample(_ id: Int) throws -> PhotogrammetrySample {
    PhotogrammetrySample(id: id, image: try #require(CVPixelBuffer(Self.image)))
  }

  @Test func gravityIsRotatedIntoTheUprightPhoto() throws {
    var sample = try sample(0)
    #expect(sample.gravityInCamera == nil)
    // Held upright; the right side of the photo is stored as its first row.
    sample.gravity = CMAcceleration(x: 0, y: -1, z: 0)
    sample.metadata["Orientation"] = 6
    #expect(sample.gravityInCamera == [0, 1, 0])
    sample.metadata["Orientation"] = UInt32(8)
    #expect(sample.gravityInCamera == [0, -1, 0])
    // Lying on its left side, as seen by the camera.
    sample.metadata["Orientation"] = nil
    sample.gravity = CMAcceleration(x: -1, y: 0, z: 0)
    #expect(sample.gravityInCamera == [0, 1, 0])
    // Flat on a table with the screen up: the camera looks down.
    sample.gravity = CMAcceleration(x: 0, y: 0, z: -1)
    for orientation in 1...8 {
      sample.metadata["Orientation"] = orientation
      #expect(sample.gravityInCamera == [0, 0, 1])
    }
    sample.gravity = CMAcceleration()
    #expect(sample.gravityInCamera == nil)
  }

  @Test(arguments: 1...8) func depthIsRotatedLikeThePhoto(orientation: Int) throws {
    var sample = try sample(0)
    sample.metadata["Orientation"] = orientation
    let buffer = CVPixelBuffer(
      width: 5, height: 3, pixelFormat: kCVPixelFormatType_DisparityFloat16)
    let map = try #require(buffer)
    var image = RasterImage(width: 5, height: 3, channels: 1)
    for index in 0..<15 {
      // Powers of two avoid rounding.
      image.pixels[index] = UInt8(index)
      let bits = Float16(sign: .plus, exponent: -index / 2, significand: index % 2 == 0 ? 1 : 1.5)
      map.storage.write(
        [UInt8(bits.bitPattern & 255), UInt8(bits.bitPattern >> 8)],
        at: index / 5 * map.bytesPerRow + index % 5 * 2)
    }
    sample.depthDataMap = map
    let turned = try image.turned(byOrientation: orientation)
    let depth = try #require(sample.uprightDepth)
    #expect((depth.width, depth.height) == (turned.width, turned.height))
    #expect(
      depth.depths
        == turned.pixels.map { index in
          1 / Float(sign: .plus, exponent: -Int(index) / 2, significand: index % 2 == 0 ? 1 : 1.5)
        })
  }

  @Test func otherFormatsHaveNoDepth() throws {
    var sample = try sample(0)
    #expect(sample.uprightDepth == nil)
    sample.depthDataMap = sample.image
    #expect(sample.uprightDepth == nil)
    let map = CVPixelBuffer(width: 2, height: 1, pixelFormat: kCVPixelFormatType_DepthFloat32)
    sample.depthDataMap = map
    #expect(sample.uprightDepth == DepthMap(width: 2, height: 1, depths: [0, 0]))
  }

  @Test func pixelBuffersKeepTheirColors() throws {
    let buffer = try #require(CVPixelBuffer(Self.image))
    #expect(buffer.bytesPerRow == 192 && buffer.pixelFormat == kCVPixelFormatType_32BGRA)
    #expect(buffer.image == Self.image)
    #expect(buffer.storage.copy(0..<4) == [14, 7, 0, 255])
    let argb = try #require(
      CVPixelBuffer(width: 1, height: 1, pixelFormat: kCVPixelFormatType_32ARGB))
    argb.storage.write([255, 1, 2, 3], at: 0)
    #expect(argb.image?.pixels == [1, 2, 3])
    let depth = CVPixelBuffer(width: 1, height: 1, pixelFormat: kCVPixelFormatType_DepthFloat32)
    #expect(depth?.image == nil)
  }

  @Test func exifCanBeReadBack() throws {
    var sample = try sample(1)
    sample.metadata = [
      "Orientation": 6,
      "{TIFF}": ["Make": "Maker", "Model": "M"],
      "{Exif}": [
        "FocalLength": 4.25, "FocalLenIn35mmFilm": 26, "LensModel": "Lens", "BodySerialNumber": "7",
      ],
      "{GPS}": [
        "Latitude": 52.5, "LatitudeRef": "N", "Longitude": 13.4, "LongitudeRef": "W",
        "Altitude": 34.0,
      ],
    ]
    let png = try ImageCodec.encodePNG(Self.image)
    let bytes = sample.exif.inserted(intoPNG: png)
    let read = PhotoMetadata(bytes)
    #expect(read.make == "Maker" && read.model == "M" && read.lens == "Lens")
    #expect(read.orientation == 6 && read.bodySerialNumber == "7")
    #expect(read.focalLength == 4.25 && read.focalLengthIn35mmFilm == 26)
    let position = try #require(read.position)
    #expect(abs(position.latitudeDegrees - 52.5) < 1e-6)
    #expect(abs(position.longitudeDegrees + 13.4) < 1e-6 && position.altitude == 34)
    #expect(try ImageCodec.decode(bytes) == Self.image)
  }

  @Test func intrinsicsBecomeAFocalLength() throws {
    var sample = try sample(1)
    sample.camera = .init(
      id: 0, intrinsics: simd_float3x3(diagonal: [37, 37, 1]), transform: .init(1))
    let read = PhotoMetadata(
      sample.exif.inserted(intoPNG: try ImageCodec.encodePNG(Self.image)))
    #expect(read.focalLength == 36 && read.focalLengthIn35mmFilm == 36)
  }

  @Test(arguments: [1e300, -1e300]) func anyMetadataCanBeWritten(number: Double) throws {
    var sample = try sample(1)
    sample.metadata = ["{Exif}": ["FocalLength": number, "FocalLenIn35mmFilm": number]]
    #expect(!sample.exif.bytes.isEmpty)
    sample.camera = .init(
      id: 0, intrinsics: simd_float3x3(diagonal: [Float.greatestFiniteMagnitude, 1, 1]),
      transform: .init(1))
    #expect(!sample.exif.bytes.isEmpty)
  }

  @Test func samplesAreLoadedFromFiles() throws {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("IMG_0042.png")
      var original = try sample(42)
      original.metadata = ["{TIFF}": ["Make": "Maker"], "Orientation": 3]
      let png = original.exif.inserted(intoPNG: try ImageCodec.encodePNG(Self.image))
      try Data(png).write(to: url)
      let loaded = try PhotogrammetrySample(contentsOf: url)
      #expect(loaded.id == 42 && loaded.image.image == Self.image && loaded.orientation == .down)
      #expect((loaded.metadata["{TIFF}"] as? [String: Any])?["Make"] as? String == "Maker")
      let text = folder.appendingPathComponent("text.jpg")
      try Data("text".utf8).write(to: text)
      for bad in [text, folder.appendingPathComponent("missing.jpg")] {
        #expect(throws: ProcessingError.self) { try PhotogrammetrySample(contentsOf: bad) }
      }
    }
  }

  @Test func sequencesAreIteratedOnceAndLazily() throws {
    let madeCount = Locked(0)
    let image = try #require(CVPixelBuffer(Self.image))
    let depth = try #require(
      CVPixelBuffer(width: 9, height: 9, pixelFormat: kCVPixelFormatType_DepthFloat32))
    let ids = [5, 3, 5, -1, 9, 7]
    let samples = ids.lazy.map { id in
      madeCount.withLock { $0 += 1 }
      return PhotogrammetrySample(id: id, image: id == 9 ? depth : image)
    }
    let folder = SampleFolder(samples)
    #expect(madeCount.withLock { $0 } == 0)
    var rejected: [Int] = []
    func note(_ event: PipelineEvent) {
      if case .rejected(let photo) = event { rejected.append(photo.sampleID) }
    }
    let url = try folder.write(flag: CancellationFlag(), onEvent: note)
    #expect(url.deletingLastPathComponent().path == ScratchFolder.parent.path)
    #expect(folder.ids == [5, 3, 7] && rejected == [5, -1, 9])
    #expect(try folder.write(flag: CancellationFlag(), onEvent: { _ in }) == url)
    #expect(madeCount.withLock { $0 } == ids.count)
    let files = try FileManager.default.contentsOfDirectory(atPath: url.path).sorted()
    #expect(files == ["sample0.png", "sample1.png", "sample2.png"])
    let photo = folder.translated(
      RejectedPhoto(
        sampleID: 1, name: "sample1.png", fault: .blurred, reason: "sample1.png is blurred."))
    #expect(photo.sampleID == 3 && photo.reason == "Sample 3 is blurred.")
  }

  private func mask(_ width: Int, _ height: Int, value: UInt8) throws -> CVPixelBuffer {
    let buffer = try #require(
      CVPixelBuffer(width: width, height: height, pixelFormat: kCVPixelFormatType_OneComponent8))
    for row in 0..<height / 2 {
      buffer.storage.write(Array(repeating: value, count: width), at: row * buffer.bytesPerRow)
    }
    return buffer
  }

  @Test func masksAreWrittenNextToTheirPhotos() throws {
    let masks = [
      try mask(37, 20, value: 1), nil, try mask(36, 20, value: 9), CVPixelBuffer(Self.image),
      try mask(37, 20, value: 0),
    ]
    let samples = try masks.enumerated().map { index, mask in
      var sample = try sample(index + 10)
      sample.objectMask = mask
      sample.metadata = ["Orientation": 3]
      return sample
    }
    let folder = SampleFolder(samples)
    var warnings: [String] = []
    let url = try folder.write(flag: CancellationFlag()) { event in
      if case .warning(let sentence) = event { warnings.append(sentence) }
    }
    let names = try FileManager.default.contentsOfDirectory(atPath: url.path).sorted()
    #expect(names == ["sample0.png", "sample0_mask.png"] + (1..<5).map { "sample\($0).png" })
    #expect(warnings.count == 3)
    for (warning, id) in zip(warnings, [12, 13, 14]) {
      #expect(warning.hasPrefix("The object mask of sample \(id) is not used"))
    }
    let bytes = try ImageCodec.contents(of: url.appendingPathComponent("sample0_mask.png"))
    let written = try ImageCodec.decode(bytes)
    #expect((written.width, written.height) == (37, 20))
    #expect(written.pixels.prefix(37 * 10 * 3).allSatisfy { $0 == 1 })
    #expect(written.pixels.dropFirst(37 * 10 * 3).allSatisfy { $0 == 0 })
    #expect(PhotoMetadata(bytes).orientation == 3)
  }

  @Test func readingsBelongToTheirPhotos() throws {
    let depth = try #require(
      CVPixelBuffer(width: 2, height: 1, pixelFormat: kCVPixelFormatType_DepthFloat32))
    depth.storage.write([0, 0, 0, 64, 0, 0, 128, 63], at: 0)  // 2 and 1
    var deep = try sample(4)
    deep.depthDataMap = depth
    deep.gravity = CMAcceleration(x: -1, y: 0, z: 0)
    var wrong = try sample(9)
    wrong.depthDataMap = wrong.image
    let folder = SampleFolder([try sample(2), deep, wrong])
    var warnings: [String] = []
    _ = try folder.write(flag: CancellationFlag()) { event in
      if case .warning(let sentence) = event { warnings.append(sentence) }
    }
    #expect(folder.readings[0] == SensorReading() && folder.readings[2] == SensorReading())
    #expect(folder.readings[1]?.gravity == [0, 1, 0])
    #expect(folder.readings[1]?.depth == DepthMap(width: 2, height: 1, depths: [2, 1]))
    #expect(warnings.count == 1 && warnings[0].hasPrefix("The depth map of sample 9 is not used"))
  }

  @Test func canceledSequencesResume() throws {
    let image = try #require(CVPixelBuffer(Self.image))
    let flag = CancellationFlag()
    let samples = (0..<4).lazy.map { id in
      if id == 2 { flag.cancel() }
      return PhotogrammetrySample(id: id, image: image)
    }
    let folder = SampleFolder(samples)
    #expect(throws: CancellationError.self) { try folder.write(flag: flag, onEvent: { _ in }) }
    _ = try folder.write(flag: CancellationFlag(), onEvent: { _ in })
    #expect(folder.ids == [0, 1, 2, 3])
  }

  @Test func emptySequencesAreAnError() {
    let folder = SampleFolder([PhotogrammetrySample]())
    #expect(throws: ProcessingError.self) {
      try folder.write(flag: CancellationFlag(), onEvent: { _ in })
    }
  }
}
