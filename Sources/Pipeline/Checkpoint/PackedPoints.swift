import Foundation
import SceneModel

/// Sparse points as bytes. A thousand photos have millions of observations, which every process
/// that works on them reads: one by one, that takes seconds.
struct PackedPoints: Codable {
  private var bytes: Data

  init(_ points: [ScenePoint]) {
    let tracks = points.map(\.track).joined()
    bytes = Data()
    append([UInt64(points.count), UInt64(tracks.count)])
    append(points.map(\.position).flatMap { [$0.x, $0.y, $0.z] })
    append(points.map(\.error))
    append(points.map(\.color).flatMap { [$0.x, $0.y, $0.z] })
    append(points.map { UInt32($0.track.count) })
    append(tracks.map { UInt32($0.photo.index) })
    append(tracks.map(\.feature))
    append(tracks.flatMap { [$0.pixel.x, $0.pixel.y] })
  }

  private mutating func append(_ values: [some BitwiseCopyable]) {
    values.withUnsafeBytes { bytes.append(contentsOf: $0) }
  }

  /// The points; nil if the bytes are malformed.
  var points: [ScenePoint]? { bytes.withUnsafeBytes(Self.points) }

  /// Limit: the bytes of a point and of an observation.
  private static let (pointBytes, observationBytes) = (4 * 8 + 3 + 4, 4 + 4 + 2 * 8)

  private static func points(_ bytes: UnsafeRawBufferPointer) -> [ScenePoint]? {
    guard bytes.count >= 16 else { return nil }
    var reader = ArrayReader(bytes: bytes, offset: 0)
    let counts = reader.array(2, of: UInt64.self)
    guard counts.allSatisfy({ $0 <= UInt64(bytes.count) }) else { return nil }
    let (count, observations) = (Int(counts[0]), Int(counts[1]))
    guard bytes.count == 16 + count * pointBytes + observations * observationBytes else {
      return nil
    }
    let positions = reader.array(3 * count, of: Double.self)
    let errors = reader.array(count, of: Double.self)
    let colors = reader.array(3 * count, of: UInt8.self)
    let lengths = reader.array(count, of: UInt32.self)
    let photos = reader.array(observations, of: UInt32.self)
    let features = reader.array(observations, of: Int32.self)
    let pixels = reader.array(2 * observations, of: Double.self)
    guard lengths.reduce(0, { $0 + Int($1) }) == observations else { return nil }
    var next = 0
    return (0..<count).map { point in
      let track = (next..<next + Int(lengths[point])).map { index in
        Observation(
          photo: ID(Int(photos[index])), feature: features[index],
          pixel: [pixels[2 * index], pixels[2 * index + 1]])
      }
      next += track.count
      let i = 3 * point
      return ScenePoint(
        position: [positions[i], positions[i + 1], positions[i + 2]],
        color: [colors[i], colors[i + 1], colors[i + 2]], error: errors[point], track: track)
    }
  }
}
