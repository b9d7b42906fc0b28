import ImageFiles
import Kernels
import Pipeline
import SceneModel

/// Writes a sequence of samples to a folder, one after another, for the pipeline to read.
///
/// The sequence is iterated once, when its photos are needed; the files are kept until the session
/// is deallocated. Used on the session's thread only, hence `@unchecked`.
final class SampleFolder: @unchecked Sendable {
  /// The sample ids in the order of the files.
  private(set) var ids: [Int] = []
  /// Gravity and depth by file number.
  private(set) var readings: [Int: SensorReading] = [:]

  private let next: () -> PhotogrammetrySample?
  private var folder: ScratchFolder?
  private var seen: Set<Int> = []
  private var isComplete = false
  private var rejected: [RejectedPhoto] = []

  init<S: Sequence>(_ samples: S) where S.Element == PhotogrammetrySample {
    var iterator: S.Iterator?
    next = {
      if iterator == nil { iterator = samples.makeIterator() }
      return iterator?.next()
    }
  }

  /// Writes the remaining samples and returns the folder.
  func write(
    flag: CancellationFlag, onEvent: (PipelineEvent) -> Void
  ) throws -> URL {
    let folder = try makeFolder()
    rejected.forEach { onEvent(.rejected($0)) }
    while !isComplete {
      if flag.isCancelled { throw CancellationError() }
      guard let sample = next() else {
        isComplete = true
        break
      }
      try write(sample, to: folder, onEvent)
    }
    guard !ids.isEmpty else {
      throw ProcessingError(
        code: .invalidInput, reason: "The sequence holds no usable sample.",
        remedy: "Pass 20 or more samples with 32BGRA or 32ARGB images of one object.")
    }
    return folder
  }

  private func write(
    _ sample: PhotogrammetrySample, to folder: URL, _ onEvent: (PipelineEvent) -> Void
  ) throws {
    func reject(_ reason: String) {
      let photo = RejectedPhoto(
        sampleID: sample.id, name: "Sample \(sample.id)", fault: .unsupportedFormat,
        reason: "Sample \(sample.id) is not used: \(reason).")
      rejected.append(photo)
      onEvent(.rejected(photo))
    }
    guard (0...Int(Int32.max)).contains(sample.id) else {
      return reject("its id is not between 0 and \(Int32.max)")
    }
    guard seen.insert(sample.id).inserted else { return reject("its id is a duplicate") }
    guard let image = sample.image.image else {
      return reject("its image is neither 32BGRA nor 32ARGB")
    }
    let png = sample.exif.inserted(intoPNG: try ImageCodec.encodePNG(image))
    try Data(png).write(to: folder.appendingPathComponent(Self.name(ids.count)))
    if let mask = sample.objectMask { try write(mask, of: sample, to: folder, onEvent) }
    readings[ids.count] = SensorReading(
      gravity: sample.gravityInCamera, depth: depth(of: sample, onEvent))
    ids.append(sample.id)
  }

  /// Writes a mask next to its photo, where the pipeline searches for it, in the same orientation.
  private func write(
    _ mask: CVPixelBuffer, of sample: PhotogrammetrySample, to folder: URL,
    _ onEvent: (PipelineEvent) -> Void
  ) throws {
    func reject(_ reason: String) {
      onEvent(
        .warning("The object mask of sample \(sample.id) is not used: \(reason)."))
    }
    guard let image = mask.grayImage else { return reject("it is not OneComponent8") }
    guard (mask.width, mask.height) == (sample.image.width, sample.image.height) else {
      return reject("its size differs from the image's")
    }
    guard image.pixels.contains(where: { $0 > 0 }) else { return reject("all its pixels are zero") }
    let png = sample.exif.inserted(intoPNG: try ImageCodec.encodePNG(image))
    try Data(png).write(to: folder.appendingPathComponent(Self.maskName(ids.count)))
  }

  private func depth(
    of sample: PhotogrammetrySample, _ onEvent: (PipelineEvent) -> Void
  ) -> DepthMap? {
    guard sample.depthDataMap != nil else { return nil }
    guard let depth = sample.uprightDepth else {
      onEvent(
        .warning(
          "The depth map of sample \(sample.id) is not used: it has no depths or disparities."))
      return nil
    }
    return depth
  }

  /// The file name of the sample with number `index` in the sequence.
  static func name(_ index: Int) -> String { "sample\(index).png" }

  /// The file name of that sample's mask.
  static func maskName(_ index: Int) -> String { "sample\(index)_mask.png" }

  /// Converts the rejection of a file to that of its sample.
  func translated(_ photo: RejectedPhoto) -> RejectedPhoto {
    guard ids.indices.contains(photo.sampleID) else { return photo }
    var result = photo
    result.sampleID = ids[photo.sampleID]
    result.name = "Sample \(result.sampleID)"
    result.reason = photo.reason.replacingOccurrences(of: photo.name, with: result.name)
    return result
  }

  private func makeFolder() throws -> URL {
    if let folder { return folder.url }
    let created = try ScratchFolder()
    folder = created
    return created.url
  }
}
