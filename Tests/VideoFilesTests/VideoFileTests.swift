import DamagedInput
import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import VideoFiles

/// Why the tests of this folder that read videos are left out.
let missing: String? =
  VideoWriter.program == nil ? "the program ffmpeg is not installed" : VideoSupport.current.remedy

@Suite(.enabled(if: missing == nil, "\(missing ?? "")")) struct VideoFileTests {
  private let width = 96
  private let height = 64
  /// One color per quarter of a frame, row by row.
  private let quarters: [SIMD3<Int>] = [
    [200, 40, 30], [60, 180, 70], [40, 60, 210], [240, 235, 220],
  ]

  private func frame(_ index: Int = 0) -> RasterImage {
    var image = RasterImage(width: width, height: height, channels: 3)
    for y in 0..<height {
      for x in 0..<width {
        let color = quarters[(2 * y / height) * 2 + 2 * x / width]
        for c in 0..<3 { image.pixels[(y * width + x) * 3 + c] = UInt8(color[c]) }
      }
    }
    return image
  }

  /// The color in the middle of a quarter.
  private func color(_ image: RasterImage, _ quarter: Int) -> SIMD3<Int> {
    let x = (quarter % 2 * 2 + 1) * image.width / 4
    let y = (quarter / 2 * 2 + 1) * image.height / 4
    return SIMD3((0..<3).map { Int(image.pixels[(y * image.width + x) * 3 + $0]) })
  }

  private func distance(_ a: SIMD3<Int>, _ b: SIMD3<Int>) -> Int {
    (0..<3).map { abs(a[$0] - b[$0]) }.max() ?? 0
  }

  private func write(_ writer: VideoWriter, as name: String, count: Int = 3, to folder: URL) throws
    -> URL
  {
    let url = folder.appendingPathComponent(name)
    try writer.write(to: url, width: width, height: height, count: count) { frame($0) }
    return url
  }

  private func colors(of matrix: String, range: String = "tv", pixels: String = "yuv420p")
    -> VideoWriter
  {
    var writer = VideoWriter()
    writer.codec = ["-c:v", "libx264", "-qp", "2", "-pix_fmt", pixels]
    let name = matrix == "bt470bg" ? "bt601" : matrix
    writer.colors = [
      "-vf", "scale=out_color_matrix=\(name):out_range=\(range):flags=accurate_rnd+full_chroma_int",
      "-colorspace", matrix, "-color_range", range,
    ]
    return writer
  }

  @Test(arguments: ["bt709", "bt470bg"], ["tv", "pc"])
  func colorsSurviveEncoding(matrix: String, range: String) throws {
    for pixels in ["yuv420p", "yuv444p", "yuv420p10le", "yuv422p10le"] {
      try withTemporaryFolder { folder in
        let url = try write(
          colors(of: matrix, range: range, pixels: pixels), as: "a.mp4", to: folder)
        let video = try VideoFile(url, threadCount: 1)
        #expect(try video.next() == 0)
        let image = try video.colors()
        for quarter in 0..<4 {
          #expect(distance(color(image, quarter), quarters[quarter]) <= 3, "\(pixels)")
        }
      }
    }
  }

  /// HEVC, MPEG-4, Motion JPEG, VP9 and ProRes in the containers that are usual for them.
  @Test(arguments: [
    ("a.mov", ["-c:v", "libx265", "-x265-params", "log-level=none", "-crf", "8"]),
    ("a.mp4", ["-c:v", "mpeg4", "-q:v", "2"]), ("a.avi", ["-c:v", "mjpeg", "-q:v", "2"]),
    ("a.webm", ["-c:v", "libvpx-vp9", "-crf", "8", "-b:v", "0"]),
    ("a.mov", ["-c:v", "prores_ks"]), ("a.mkv", ["-c:v", "libx264", "-crf", "8"]),
  ]) func codecsAreRead(name: String, codec: [String]) throws {
    try withTemporaryFolder { folder in
      var writer = colors(of: "bt709")
      writer.codec = codec
      let video = try VideoFile(write(writer, as: name, to: folder), threadCount: 2)
      #expect((video.width, video.height) == (width, height))
      var times: [Double] = []
      while let time = try video.next() { times.append(time) }
      #expect(times.count == 3)
      for (index, time) in times.enumerated() { #expect(abs(time - Double(index) / 24) < 0.002) }
    }
  }

  /// A copy whose track header has the matrix of a clockwise rotation (ISO/IEC 14496-12, 8.3.2):
  /// x' = a x + c y, y' = b x + d y, with y downward.
  private func turned(_ file: URL, clockwise degrees: Int) throws -> URL {
    var bytes = [UInt8](try Data(contentsOf: file))
    let type = Array("tkhd".utf8)
    let header = try #require((0..<bytes.count - 80).first { Array(bytes[$0..<$0 + 4]) == type })
    let radians = Double(degrees) * .pi / 180
    let (sine, cosine) = (Int32(sin(radians).rounded()), Int32(cos(radians).rounded()))
    // Rows of three: a b u, c d v.
    for (place, value) in [(0, cosine), (1, sine), (3, -sine), (4, cosine)] {
      let fixed = UInt32(bitPattern: value << 16)
      for byte in 0..<4 {
        bytes[header + 4 + 40 + 4 * place + byte] =
          UInt8(truncatingIfNeeded: fixed >> (24 - 8 * UInt32(byte)))
      }
    }
    let copy = file.deletingLastPathComponent().appendingPathComponent("turned.mp4")
    try Data(bytes).write(to: copy)
    return copy
  }

  @Test(arguments: [90, 180, 270]) func framesAreUpright(degrees: Int) throws {
    try withTemporaryFolder { folder in
      let stored = try write(colors(of: "bt709"), as: "stored.mp4", to: folder)
      let turned = try turned(stored, clockwise: degrees)
      let video = try VideoFile(turned, threadCount: 1)
      _ = try video.next()
      let image = try video.colors()
      let isSideways = degrees != 180
      #expect((image.width, image.height) == (isSideways ? (height, width) : (width, height)))
      #expect((video.width, video.height) == (image.width, image.height))
      // Clockwise: what was at the top left is at the top right, the bottom right, the bottom left.
      let corner = [90: 1, 180: 3, 270: 2][degrees] ?? 0
      #expect(distance(color(image, corner), quarters[0]) <= 3)
    }
  }

  /// The reference white of HDR becomes white, and its primaries those of sRGB.
  @Test func hdrBecomesSRGB() throws {
    // Gray of the brightness 0.25 of white: HLG light 0.265 · 0.25^(1 / 1.2) of the scene.
    func hlg(_ light: Double) -> Double {
      light <= 1 / 12
        ? (3 * light).squareRoot() : 0.17883277 * log(12 * light - 0.28466892) + 0.55991073
    }
    let white = hlg(0.265), gray = hlg(0.265 * pow(0.25, 1 / 1.2))
    try withTemporaryFolder { folder in
      for (value, expected) in [(white, 255), (gray, 137)] {
        var writer = VideoWriter()
        writer.codec = ["-c:v", "libx264", "-qp", "1", "-pix_fmt", "yuv420p10le"]
        writer.colors = [
          "-vf", "scale=out_color_matrix=bt2020:out_range=tv", "-colorspace", "bt2020nc",
          "-color_primaries", "bt2020", "-color_trc", "arib-std-b67", "-color_range", "tv",
        ]
        let url = folder.appendingPathComponent("\(expected).mp4")
        let level = UInt8((255 * value).rounded())
        try writer.write(to: url, width: width, height: height, count: 1) { _ in
          RasterImage(width: width, height: height, channels: 3, filledWith: level)
        }
        let video = try VideoFile(url, threadCount: 1)
        _ = try video.next()
        let found = color(try video.colors(), 0)
        #expect(distance(found, SIMD3(repeating: expected)) <= 3, "\(found)")
      }
    }
  }

  @Test func brightnessIsReducedByAveraging() throws {
    try withTemporaryFolder { folder in
      let video = try VideoFile(write(colors(of: "bt709"), as: "a.mp4", to: folder), threadCount: 1)
      _ = try video.next()
      let gray = try video.brightness(longerSide: 24)
      #expect((gray.width, gray.height) == (24, 16))
      // Light gray is brighter than green, red and blue.
      let middles: [(Int, Int)] = [(6, 4), (18, 4), (6, 12), (18, 12)]
      let levels = middles.map { x, y in gray.pixels[y * 24 + x] }
      #expect(levels[3] > levels[1] && levels[1] > levels[0] && levels[3] > levels[2])
      #expect(abs(Int(levels[3]) - 235) < 4)
    }
  }

  @Test func theCameraIsNamed() throws {
    try withTemporaryFolder { folder in
      var writer = colors(of: "bt709")
      writer.codec += ["-movflags", "use_metadata_tags"]
      writer.metadata = [
        ("com.apple.quicktime.make", "Apple"), ("com.apple.quicktime.model", "iPhone 15"),
      ]
      let video = try VideoFile(write(writer, as: "a.mov", to: folder), threadCount: 1)
      #expect(video.camera.make == "Apple" && video.camera.model == "iPhone 15")
    }
  }

  @Test func limitsAreChecked() throws {
    try withTemporaryFolder { folder in
      let url = try write(colors(of: "bt709"), as: "a.mp4", to: folder)
      var limits = ImageCodec.Limits()
      limits.maximumSide = 90
      #expect(throws: VideoError.self) { try VideoFile(url, threadCount: 1, limits: limits) }
    }
  }

  @Test func otherFilesAreRefused() throws {
    try withTemporaryFolder { folder in
      for (name, content) in [
        ("empty.mov", ""), ("text.mov", "This is not a video, whatever its name says.\n"),
        ("list.m3u8", "#EXTM3U\n#EXTINF:1,\nfile:///etc/passwd\n"),
        ("concat.txt", "ffconcat version 1.0\nfile a.mp4\n"),
      ] {
        let url = folder.appendingPathComponent(name)
        try Data(content.utf8).write(to: url)
        #expect(throws: VideoError.self) { try VideoFile(url, threadCount: 1) }
      }
      #expect(throws: VideoError.self) {
        try VideoFile(folder.appendingPathComponent("absent.mov"), threadCount: 1)
      }
    }
  }

  /// Damage may cost frames, never the process.
  @Test func damagedVideosAreReadAsFarAsPossible() throws {
    try withTemporaryFolder { folder in
      let url = try write(colors(of: "bt709"), as: "a.mp4", count: 24, to: folder)
      let damaged = DamagedInput([UInt8](try Data(contentsOf: url)))
      let copies =
        Array(damaged.truncations(step: damaged.bytes.count / 20))
        + Array(damaged.mutations(150, seed: 9, header: damaged.bytes.count))
      var complete = 0
      for copy in copies {
        let file = folder.appendingPathComponent("damaged.mp4")
        try Data(copy).write(to: file)
        do {
          let video = try VideoFile(file, threadCount: 1)
          var count = 0
          while try video.next() != nil {
            _ = try video.brightness(longerSide: 32)
            count += 1
          }
          if count > 0 { complete += 1 }
        } catch is VideoError {}
      }
      #expect(complete > copies.count / 4)
    }
  }
}
