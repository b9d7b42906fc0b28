import ArgumentParser
import VideoFiles

/// Which frames of a video become photos.
struct VideoArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      """
      Number of photos made of a video, from 3 to 1000. (default: by the camera's path, 40 to 250)
      """, valueName: "count"))
  var frames: Int?

  func validate() throws {
    if let frames, !(3...1000).contains(frames) {
      throw ValidationError("--frames must be from 3 to 1000.")
    }
  }

  var options: VideoFrames.Options {
    var options = VideoFrames.Options()
    options.count = frames
    return options
  }

  static let help = """
    VIDEOS
      A video filmed in one slow walk around the object (MP4, QuickTime, Matroska,
      AVI, MPEG). Its frames become photos: the sharpest ones at even distances
      along the camera's path. 'photogrammetry-cli frames clip.mov photos/' saves
      them. Photos have more pixels and less motion blur than videos.

    """
}
