import Foundation
import SceneModel

/// The numbers of pairs and of guided ones, a record of each, then the matches and the inliers of
/// each, in native byte order.
extension MatchBlock: UnitValue {
  func unitData() throws -> Data {
    let lists = matches + guided.map { _ in [] }
    let verdicts = verdicts + guided.map { .verified($0) }
    let records = zip(lists, verdicts).map { PairRecord(matches: $0.count, $1) }
    var data =
      Data(bytesOf: [UInt64(matches.count), UInt64(guided.count)]) + Data(bytesOf: records)
    for (matches, verdict) in zip(lists, verdicts) {
      data += Data(bytesOf: matches) + Data(bytesOf: verdict.inliers)
    }
    return data
  }

  init?(unit: Data) {
    let (countSize, size) = (2 * MemoryLayout<UInt64>.size, MemoryLayout<PairRecord>.stride)
    let counts = unit.prefix(countSize).values(of: UInt64.self)
    guard counts.count == 2, counts.allSatisfy({ $0 <= UInt64(unit.count) }),
      counts[0] + counts[1] <= UInt64((unit.count - countSize) / size)
    else { return nil }
    let end = countSize + Int(counts[0] + counts[1]) * size
    let records = Data(unit.prefix(end).dropFirst(countSize)).values(of: PairRecord.self)
    let rest = Data(unit.dropFirst(end))
    guard records.allSatisfy(\.isValid),
      records.reduce(0, { $0 + $1.matchTotal }) * MemoryLayout<FeatureMatch>.stride == rest.count
    else { return nil }
    rest.withUnsafeBytes { bytes in
      var reader = ArrayReader(bytes: bytes, offset: 0)
      for (number, record) in records.enumerated() {
        let own = reader.array(Int(record.matches), of: FeatureMatch.self)
        let verdict = record.verdict(
          inliers: reader.array(Int(record.inliers), of: FeatureMatch.self))
        if number < Int(counts[0]) {
          matches.append(own)
          verdicts.append(verdict)
        } else if let pair = verdict.geometry {
          guided.append(pair)
        }
      }
    }
  }
}

extension PairVerification.Verdict {
  /// The pair with its geometry, if there is one.
  fileprivate var geometry: VerifiedPair? {
    switch self {
    case .verified(let pair): pair
    case .rejected(let pair): pair.weak
    }
  }

  fileprivate var inliers: [FeatureMatch] { geometry?.matches ?? [] }
}

/// The verdict on a pair without its matches.
private struct PairRecord: BitwiseCopyable {
  /// The models by number.
  private static let models: [VerifiedPair.Model] = [.essential, .fundamental, .homography]

  /// Of `secondFromFirst`, and the median angle as the last value; all are 0 without a pose.
  private var rotation = SIMD4<Double>()
  private var translationAndAngle = SIMD4<Double>()
  private var first: Int32
  private var second: Int32
  /// The numbers of matches and inliers.
  private(set) var matches: Int32
  private(set) var inliers: Int32
  private var isVerified: Int32 = 0
  /// -1 without a geometry.
  private var model: Int32 = -1
  /// Of a rejected pair.
  private var agreeing: Int32 = 0
  private var needed: Int32 = 0

  init(matches: Int, _ verdict: PairVerification.Verdict) {
    let pair: PhotoPair
    switch verdict {
    case .verified(let verified): (pair, isVerified) = (verified.pair, 1)
    case .rejected(let rejected):
      (pair, agreeing, needed) = (rejected.pair, Int32(rejected.matches), Int32(rejected.needed))
    }
    (first, second) = (Int32(pair.first.index), Int32(pair.second.index))
    (self.matches, inliers) = (Int32(matches), Int32(verdict.inliers.count))
    guard let geometry = verdict.geometry else { return }
    model = Int32(Self.models.firstIndex(of: geometry.model) ?? 0)
    translationAndAngle.w = geometry.medianAngle
    guard let pose = geometry.secondFromFirst else { return }
    let turn = pose.rotation
    rotation = [turn.x, turn.y, turn.z, turn.w]
    translationAndAngle = SIMD4(pose.translation, geometry.medianAngle)
  }

  /// Whether a verdict can be made of it.
  var isValid: Bool {
    let models: Range<Int32> = -1..<Int32(Self.models.count)
    return first >= 0 && second >= 0 && matches >= 0 && inliers >= 0 && models.contains(model)
      && (isVerified == 0 || model >= 0)
  }

  var matchTotal: Int { Int(matches) + Int(inliers) }

  func verdict(inliers: [FeatureMatch]) -> PairVerification.Verdict {
    let pair = PhotoPair(ID(Int(first)), ID(Int(second)))
    let geometry = model < 0 ? nil : geometry(of: pair, inliers)
    if isVerified != 0, let geometry { return .verified(geometry) }
    return .rejected(
      RejectedPair(pair: pair, matches: Int(agreeing), needed: Int(needed), weak: geometry))
  }

  private func geometry(of pair: PhotoPair, _ inliers: [FeatureMatch]) -> VerifiedPair {
    let (turn, moved) = (rotation, translationAndAngle)
    let pose = RigidTransform(
      rotation: Quaternion(x: turn.x, y: turn.y, z: turn.z, w: turn.w),
      translation: [moved.x, moved.y, moved.z])
    return VerifiedPair(
      pair: pair, model: Self.models[Int(model)],
      secondFromFirst: turn == .zero ? nil : pose, matches: inliers,
      medianAngle: moved.w)
  }
}
