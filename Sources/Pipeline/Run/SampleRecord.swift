import Foundation
import SceneModel

/// The samples of a scene, from which another process makes its surface, and what is known of the
/// stages up to there.
struct SampleRecord: Sendable {
  var samples: SurfaceSamples
  var denseNotes: SavedNotes
  var notes: SavedNotes
}

/// The byte count of a property list, the list, and the cloud of the samples, which a list would
/// copy several times.
extension SampleRecord: UnitValue {
  /// All but the cloud.
  private struct Record: LargeUnitValue {
    var voxelSize: Double
    var isObject: Bool
    var support: SupportPlane?
    var denseNotes: SavedNotes
    var notes: SavedNotes
  }

  private static let countSize = MemoryLayout<UInt64>.size

  init?(unit: Data) {
    guard let count = unit.prefix(Self.countSize).values(of: UInt64.self).first,
      count <= UInt64(unit.count - Self.countSize)
    else { return nil }
    let rest = unit.dropFirst(Self.countSize)
    guard let record = Record(unit: Data(rest.prefix(Int(count)))),
      let cloud = PointCloud(unit: rest.dropFirst(Int(count)))
    else { return nil }
    samples = SurfaceSamples(
      cloud: cloud, voxelSize: record.voxelSize, isObject: record.isObject,
      support: record.support)
    (denseNotes, notes) = (record.denseNotes, record.notes)
  }

  func unitData() throws -> Data {
    let record = try Record(
      voxelSize: samples.voxelSize, isObject: samples.isObject, support: samples.support,
      denseNotes: denseNotes, notes: notes
    ).unitData()
    return samples.cloud.encoded(after: Data(bytesOf: [UInt64(record.count)]) + record)
  }
}
