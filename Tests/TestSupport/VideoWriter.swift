import Foundation
import SceneModel

/// Encodes videos with the program `ffmpeg`, if it is installed.
package struct VideoWriter {
  /// Arguments before the frames on standard input, such as a rotation.
  package var inputArguments: [String] = []
  /// The codec and its options. The default is that of phones.
  package var codec = ["-c:v", "libx264", "-preset", "medium", "-crf", "20", "-pix_fmt", "yuv420p"]
  /// The colors that the frames are converted to, and that the stream declares.
  package var colors = [
    "-vf", "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int",
    "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
    "-color_range", "tv",
  ]
  package var framesPerSecond = 24.0
  /// Written to the container: name and value.
  package var metadata: [(String, String)] = []

  package init() {}

  /// The path of the program; nil if it is not installed.
  package static let program = ["/usr/bin/ffmpeg", "/usr/local/bin/ffmpeg"].first {
    FileManager.default.isExecutableFile(atPath: $0)
  }

  package enum Failure: Error { case notInstalled, failed(Int32) }

  /// Encodes `count` RGB frames of one size, which `frame` returns in order, to the file at `url`.
  package func write(
    to url: URL, width: Int, height: Int, count: Int, frame: (Int) throws -> RasterImage
  ) throws {
    guard let program = Self.program else { throw Failure.notInstalled }
    let process = Process()
    process.executableURL = URL(fileURLWithPath: program)
    process.arguments =
      ["-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", "\(width)x\(height)"]
      + ["-r", "\(framesPerSecond)"] + inputArguments + ["-i", "-"]
      + metadata.flatMap { ["-metadata", "\($0.0)=\($0.1)"] }
      + codec + colors + [url.path]
    let input = Pipe()
    process.standardInput = input
    try process.run()
    for index in 0..<count {
      try input.fileHandleForWriting.write(contentsOf: Data(frame(index).pixels))
    }
    try input.fileHandleForWriting.close()
    process.waitUntilExit()
    guard process.terminationStatus == 0 else { throw Failure.failed(process.terminationStatus) }
  }
}
