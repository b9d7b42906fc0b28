import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestSupport

/// Writes a rendered video with the cameras of all its frames and the surface.
struct VideoSet {
  let video: WalkAroundVideo

  /// Writes `clip.mp4`, `gt/cameras.json` and `gt/mesh.ply`.
  func write(to folder: URL, _ control: KernelControl) throws {
    let truth = GroundTruth(camera: video.camera, isZUp: true)
    let entries = (0..<video.frameCount).map {
      truth.entry(name($0), video.pose(at: video.middle(ofFrame: $0)))
    }
    try truth.write(entries, video.object, to: folder.appendingPathComponent("gt"))
    var writer = VideoWriter()
    writer.framesPerSecond = video.framesPerSecond
    try writer.write(
      to: folder.appendingPathComponent("clip.mp4"), width: video.width, height: video.height,
      count: video.frameCount
    ) { try video.frame($0, control) }
  }

  /// Writes photos of each frame of the video that `frames` contains: the frame itself, without the
  /// video's compression, to `photos`, and what a still camera would have shown to `stills`.
  func writePhotos(of frames: URL, to folder: URL, _ control: KernelControl) throws {
    let names = Set(try FileManager.default.contentsOfDirectory(atPath: frames.path))
    for index in 0..<video.frameCount where names.contains(name(index)) {
      for (kind, image) in [
        ("photos", try video.frame(index, control)), ("stills", try video.still(index, control)),
      ] {
        let jpeg = try ImageCodec.encodeJPEG(image, quality: 0.95)
        try writeFile(jpeg, folder.appendingPathComponent("\(kind)/\(name(index))"))
      }
    }
  }

  /// The name that `photogrammetry-cli frames` gives a frame.
  private func name(_ index: Int) -> String {
    let milliseconds = Int((Double(index) / video.framesPerSecond * 1000).rounded())
    return String(format: "clip_%04d.%03d.jpg", milliseconds / 1000, milliseconds % 1000)
  }
}
