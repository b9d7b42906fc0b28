import Foundation
import Pipeline
import SceneModel
import SharedCommands

/// The photos and files of a folder as a run would use them: what `inspect` prints.
struct InspectionReport: Encodable {
  struct Used: Encodable {
    var name: String
    /// Pixels of the upright photo.
    var width: Int
    var height: Int
    /// Index of the camera that photos with the same lens setting share.
    var camera: Int
    /// Pixels.
    var focalLength: Double
    var calibration: Camera.Calibration
    /// Whether the photo has a GPS position.
    var hasPosition: Bool
    /// Share of the photo that its mask keeps, 0…1; nil without a mask.
    var maskCoverage: Double?
  }

  struct Refused: Encodable {
    var name: String
    var fault: RejectedPhoto.Fault
    var reason: String
  }

  var used: [Used]
  var refused: [Refused]
  var refusedMasks: [RejectedMask]
  /// Number of cameras.
  var cameras: Int
  /// Whether photos would be used at a lower resolution to fit the memory.
  var isDownsampled: Bool
  var overlap: OverlapReport?

  init(_ ingested: IngestedPhotos) {
    used = ingested.photos.map { photo in
      let camera = ingested.cameras[photo.camera.index]
      return Used(
        name: photo.name, width: photo.width, height: photo.height, camera: photo.camera.index,
        focalLength: camera.focalLength.x, calibration: camera.calibration,
        hasPosition: photo.position != nil, maskCoverage: photo.mask?.coverage)
    }
    refused = ingested.rejected.map { Refused(name: $0.name, fault: $0.fault, reason: $0.reason) }
    refusedMasks = ingested.rejectedMasks
    cameras = ingested.cameras.count
    isDownsampled = ingested.isDownsampled
  }

  /// Throws if a run would fail for lack of photos.
  func checkCount() throws { try PipelineError.checkCount(used.count) }

  /// The report as JSON.
  func encoded() throws -> String {
    String(decoding: try JSONEncoder.readable.encode(self), as: UTF8.self)
  }

  /// A line per used photo, the reasons for the other files, and a summary.
  var lines: [String] {
    let width = used.map(\.name.count).max() ?? 0
    var lines = used.map { line($0, nameWidth: width) }
    lines += refused.map(\.reason) + refusedMasks.map(\.reason)
    lines.append(
      "\(used.count) photo\(used.count == 1 ? "" : "s") of "
        + "\(cameras) camera\(cameras == 1 ? "" : "s") would be used, "
        + "\(refused.count) file\(refused.count == 1 ? "" : "s") not.")
    let masks = used.count { $0.maskCoverage != nil }
    if masks > 0 { lines.append("\(masks) of \(used.count) photos have a mask.") }
    if isDownsampled {
      lines.append("Photos would be used at a lower resolution to fit the memory.")
    }
    return lines + (overlap?.lines ?? [])
  }

  private func line(_ photo: Used, nameWidth: Int) -> String {
    let name = photo.name.padding(toLength: nameWidth, withPad: " ", startingAt: 0)
    let focal = "focal length \(Int(photo.focalLength.rounded())) px (\(photo.calibration))"
    let place = photo.hasPosition ? "  GPS" : ""
    let mask = photo.maskCoverage.map { "  mask \(max(1, Int(($0 * 100).rounded()))) %" } ?? ""
    return "\(name)  \(photo.width) x \(photo.height)  camera \(photo.camera + 1)  "
      + "\(focal)\(place)\(mask)"
  }
}
