import Foundation
import Kernels
import SceneModel

/// What the results of a run depend on: numbers that change with any of it.
struct RunInputs: Sendable {
  /// Of what alignment depends on.
  let alignment: UInt64
  private let configuration: Data

  /// `readings` are by sample id.
  init(
    _ ingested: IngestedPhotos, _ configuration: PipelineConfiguration,
    readings: [Int: SensorReading]
  ) throws {
    var fingerprint = Fingerprint()
    fingerprint.add(ProgramIdentity.fingerprint)
    fingerprint.add(ingested.photos.count)
    for (photo, hash) in zip(ingested.photos, ingested.contentHashes) {
      fingerprint.add(photo.name.utf8)
      fingerprint.add(photo.sampleID)
      fingerprint.add(hash)
      // Where a mask's file is plays no part.
      fingerprint.add(photo.mask == nil ? 0 : 1)
      fingerprint.add(photo.mask?.contentHash ?? 0)
      fingerprint.add(readings[photo.sampleID] ?? SensorReading())
    }
    fingerprint.add(ingested.processingPixels)
    fingerprint.add(
      try Fingerprint.content(of: [configuration.isSequential, configuration.isHighSensitivity]))
    fingerprint.add(try Fingerprint.content(of: configuration.knownDistances))
    fingerprint.add(try Fingerprint.content(of: configuration.mappingMethod))
    alignment = fingerprint.value
    self.configuration =
      try Fingerprint.content(of: configuration.pointCloudGeneration)
      + Fingerprint.content(of: [
        configuration.isObjectMaskingEnabled, configuration.closesObject,
        configuration.refinesSurface,
      ])
  }

  /// Of what the surface depends on that is made from views of so many pixels.
  func surface(viewPixels: Int) -> UInt64 {
    var fingerprint = Fingerprint()
    fingerprint.add(alignment)
    fingerprint.add(configuration)
    fingerprint.add(viewPixels)
    return fingerprint.value
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
