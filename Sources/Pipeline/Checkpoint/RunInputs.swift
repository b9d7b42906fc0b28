import Foundation
import Kernels
import SceneModel

/// Fingerprints of everything that the results of a run depend on.
struct RunInputs: Sendable {
  /// The fingerprint of everything that alignment depends on.
  let alignment: UInt64
  /// The fingerprint of everything that estimated masks depend on.
  let masks: UInt64
  /// The fingerprint of everything that the surface depends on.
  let surface: UInt64

  /// `configuration` is specialized for the planned models, including the resolution of the dense
  /// stage.
  init(_ photos: PhotoSet, _ configuration: PipelineConfiguration) throws {
    var fingerprint = Fingerprint()
    fingerprint.add(ProgramIdentity.fingerprint)
    fingerprint.add(photos.ingested.photos.count)
    for (photo, hash) in zip(photos.ingested.photos, photos.ingested.contentHashes) {
      fingerprint.add(photo.name.utf8)
      fingerprint.add(photo.sampleID)
      fingerprint.add(hash)
      // Masks are identified by content, regardless of the location of their files.
      fingerprint.add(photo.mask == nil ? 0 : 1)
      fingerprint.add(photo.mask?.contentHash ?? 0)
      fingerprint.add(photos.readings[photo.sampleID] ?? SensorReading())
    }
    fingerprint.add(photos.ingested.processingPixels)
    func value(through stage: PipelineStage) throws -> UInt64 {
      var result = fingerprint
      result.add(try ConfigurationFingerprint.content(of: configuration, through: stage))
      return result.value
    }
    alignment = try value(through: .imageAlignment)
    masks = try value(through: .objectMasking)
    surface = try value(through: .meshGeneration)
  }
}

extension Fingerprint {
  fileprivate mutating func add(_ reading: SensorReading) {
    add(reading.gravity ?? .zero)
    add(reading.depth?.width ?? 0)
    guard let depth = reading.depth else { return }
    add(depth.mayBeDisparities ? 1 : 0)
    add(depth.depths.withUnsafeBytes { XXHash64.hash($0) })
  }
}
