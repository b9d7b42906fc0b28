import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Separates the files that phones write next to photos from the photos: for `IMG_1.HEIC` the
/// disparity map `IMG_1_depth.TIF` (or `.exr`) and the direction of gravity `IMG_1_gravity.TXT`,
/// three numbers in the frame of the phone. These are the names used by Apple's sample app that
/// captures photos for Object Capture, and by apps derived from it. Names are case-insensitive.
/// Photos may hold readings, too: see `InspectedPhoto.findReading`.
struct SensorFiles {
  /// The other files, in their original order.
  private(set) var photos: [URL] = []
  /// Larger files, in bytes, hold something other than three numbers. Chosen.
  private static let maximumGravityFileSize = 4096

  /// Depth and gravity files by the lowercase stem of their photo.
  private var depth: [String: URL] = [:]
  private var gravity: [String: URL] = [:]

  init(_ files: [URL]) {
    let names = Set(files.map(Self.name))
    for file in files {
      let suffix = file.pathExtension.lowercased()
      if let owner = Self.owner(file, "_depth"), names.contains(owner),
        ["tif", "tiff", "exr"].contains(suffix)
      {
        depth[owner] = depth[owner] ?? file
      } else if let owner = Self.owner(file, "_gravity"), names.contains(owner), suffix == "txt" {
        gravity[owner] = gravity[owner] ?? file
      } else {
        photos.append(file)
      }
    }
  }

  /// The readings stored next to a photo whose sensor pixels are rotated upright by `orientation`;
  /// those `inside` the photo stand in for missing ones. `problems` are messages about unusable
  /// files.
  func reading(
    nextTo photo: URL, orientation: Int, inside: SensorReading, _ problems: inout [String]
  ) -> SensorReading {
    let name = Self.name(photo)
    var reading = inside
    if let file = gravity[name] {
      let direction = Self.gravity(file).flatMap {
        SensorReading.gravity(ofPhone: $0, orientation: orientation)
      }
      if let direction {
        reading.gravity = direction
      } else {
        problems.append("\(file.lastPathComponent) is not used: it contains no direction.")
      }
    }
    if let file = depth[name] {
      do throws(ImageError) {
        reading.depth = try Self.depth(file).turned(byOrientation: orientation)
      } catch {
        problems.append("\(file.lastPathComponent) is not used: \(Self.reason(error)).")
      }
    }
    return reading
  }

  /// The lowercase stem of a file name.
  private static func name(_ file: URL) -> String {
    file.deletingPathExtension().lastPathComponent.lowercased()
  }

  /// The stem of the photo that a file with this ending belongs to; nil without the ending.
  private static func owner(_ file: URL, _ ending: String) -> String? {
    let name = name(file)
    return name.hasSuffix(ending) ? String(name.dropLast(ending.count)) : nil
  }

  /// The depth or disparity map in a file.
  private static func depth(_ file: URL) throws(ImageError) -> DepthMap {
    let (width, height, values) = try ImageCodec.decodeNumbers(ImageCodec.contents(of: file))
    guard var map = DepthMap(width: width, height: height, depths: values) else {
      throw .damaged("it has no pixels")
    }
    map.mayBeDisparities = true
    return map
  }

  /// The reason why a depth file is unusable; the remedies for photos don't apply to it.
  private static func reason(_ error: ImageError) -> String {
    switch error {
    case .unsupportedFormat, .notAnImage, .decoderLeftOut:
      "it is not an image of 32-bit floating-point numbers"
    case .tooLarge, .damaged, .unreadable: error.errorDescription ?? "it can't be read"
    }
  }

  /// Three numbers separated by commas.
  private static func gravity(_ file: URL) -> SIMD3<Double>? {
    var limits = ImageCodec.Limits()
    limits.maximumFileSize = maximumGravityFileSize
    guard let bytes = try? ImageCodec.contents(of: file, limits: limits) else { return nil }
    let parts = String(decoding: bytes, as: UTF8.self).split(separator: ",")
      .map { Double($0.trimmingCharacters(in: .whitespacesAndNewlines)) }
    guard parts.count == 3, let x = parts[0], let y = parts[1], let z = parts[2] else { return nil }
    return SIMD3(x, y, z)
  }
}
