import Foundation
import Kernels
import SceneModel

/// The downsampled points with the features that decide whether they belong to the object.
struct IsolationSamples {
  enum Outcome {
    /// Whether each sample belongs to the object, and the plane that it stands on.
    case object([Bool], SupportPlane?)
    /// Why there is no clear object, as a sentence.
    case failure(String)
  }

  let options: ObjectIsolation.Options
  let cloud: PointCloud
  /// Side of a sample's voxel in world units.
  let cell: Double
  let focus: ViewFocus
  /// Share of the photos that have each sample in their frame, 0…1.
  let coverage: [Float]
  /// Distance of each sample from the focus in camera distances.
  let distance: [Float]
  /// The up direction; if `isUpKnown` is false, the mean of the photos' up directions.
  let up: SIMD3<Double>
  let isUpKnown: Bool

  /// Nil if no registered photo sees a sample.
  init?(
    _ samples: VoxelDownsampling.Result, _ reconstruction: Reconstruction,
    _ options: ObjectIsolation.Options
  ) throws {
    let depths = reconstruction.medianDepths(of: samples.cloud)
    guard let focus = ViewFocus(reconstruction, depths: depths) else { return nil }
    self.options = options
    self.focus = focus
    cloud = samples.cloud
    cell = samples.voxelSize
    coverage = cloud.positions.map { Float(focus.coverage(of: SIMD3<Double>($0))) }
    distance = cloud.positions.map {
      Float((SIMD3<Double>($0) - focus.point).length / focus.distance)
    }
    isUpKnown = reconstruction.worldFrame.up != .unknown
    up = isUpKnown ? reconstruction.worldFrame.vertical : focus.meanUp
  }

  /// Detects the support plane, then selects the components of the object above it.
  func isolate(_ context: StageContext) throws -> Outcome {
    let region = cloud.positions.indices.filter {
      Double(coverage[$0]) >= options.focusCoverage && distance[$0] < 1
    }
    guard region.count >= options.minimumRegionSamples else {
      return .failure("too little is seen by most photos.")
    }
    try context.control.step(0.1)
    let support = try support(of: region, context)
    try context.control.step(0.4)
    let outcome = try outcome(on: support, region, context)
    guard options.isForeground, support != nil, case .failure = outcome else { return outcome }
    // The plane may be a face of a flat object.
    let withoutPlane = try self.outcome(on: nil, region, context)
    if case .object = withoutPlane { return withoutPlane }
    return outcome
  }

  /// The object above the plane that it stands on, if there is one.
  private func outcome(
    on support: SupportPlane?, _ region: [Int], _ context: StageContext
  ) throws -> Outcome {
    let isAbove = cloud.positions.map { position in
      support.map { $0.height(of: SIMD3<Double>(position)) > $0.band } ?? true
    }
    let isCandidate = cloud.positions.indices.map {
      isAbove[$0] && Double(coverage[$0]) >= options.objectCoverage
        && Double(distance[$0]) < options.reach
    }
    guard let isObject = try object(isCandidate, on: support, context) else {
      return .failure("there is no separate object in the photos' common view.")
    }
    let central = region.filter { distance[$0] < options.centralDistance }
    let share = central.filter { isObject[$0] }.count
    guard Double(share) >= options.minimumShare * Double(central.count) else {
      return .failure("the object in the common view is too small.")
    }
    if try truncation(isObject, isAbove, context.control) > options.maximumTruncation {
      return .failure("the surface in the photos extends beyond their common view.")
    }
    return .object(isObject, support)
  }

  /// The plane that the object stands on. Where the surroundings have little texture, a face of the
  /// object may be the dominant plane: its top. What it stands on lies below.
  private func support(of region: [Int], _ context: StageContext) throws -> SupportPlane? {
    let detection = SupportPlaneDetection(options: options.support)
    guard let (found, division) = plane(of: region, detection) else { return nil }
    if options.showsOnlyObject {
      return detection.surrounds(found, division) && !detection.hasSideFaces(division) ? found : nil
    }
    guard detection.hasSideFaces(division) else { return found }
    let rest = region.filter {
      abs(found.height(of: SIMD3<Double>(cloud.positions[$0]))) > found.band
    }
    if let (lower, division) = plane(of: rest, detection),
      detection.surrounds(lower, division), !detection.hasSideFaces(division),
      try isBounded(on: lower, context)
    {
      return lower
    }
    return try isBounded(on: nil, context) ? nil : found
  }

  /// The dominant plane of the samples `indices`, and how it divides them.
  private func plane(
    of indices: [Int], _ detection: SupportPlaneDetection
  ) -> (SupportPlane, SupportPlaneDetection.Division)? {
    let positions = indices.map { cloud.positions[$0] }
    let normals = cloud.normals.isEmpty ? [] : indices.map { cloud.normals[$0] }
    let found = detection.run(
      positions: positions, normals: normals, up: up, isUpKnown: isUpKnown, focus: focus,
      cell: cell)
    return found.map {
      ($0, detection.divide(positions, normals, by: $0, focus: focus, cell: cell))
    }
  }

  /// Whether all that is seen is one object, on `support` if there is one.
  private func isBounded(on support: SupportPlane?, _ context: StageContext) throws -> Bool {
    let isOffSupport = cloud.positions.map { position in
      support.map { abs($0.height(of: SIMD3<Double>(position))) > $0.band } ?? true
    }
    let isNear = cloud.positions.indices.map {
      isOffSupport[$0] && Double(coverage[$0]) >= options.objectCoverage
        && Double(distance[$0]) < options.reach
    }
    guard let isObject = try object(isNear, on: nil, context) else { return false }
    return Double(isObject.count { $0 })
      >= options.minimumBoundedShare * Double(isOffSupport.count { $0 })
  }

  /// The candidates in the main component and in those that belong to it; nil without any.
  private func object(
    _ isCandidate: [Bool], on support: SupportPlane?, _ context: StageContext
  ) throws -> [Bool]? {
    let indices = cloud.positions.indices.filter { isCandidate[$0] }
    guard !indices.isEmpty else { return nil }
    let grid = try VoxelGrid(
      indices.map { cloud.positions[$0] }, cellSize: cell * options.connectionSamples,
      findsComponents: true, context.control)
    let members = Members(of: grid.components, count: grid.componentCount)
    var weights = (0..<grid.componentCount).map { component in
      members[component].reduce(0.0) { sum, member in
        let index = indices[Int(member)]
        let d = Double(distance[index]) / options.weightDistance
        return sum + Double(coverage[index]) * exp(-d * d)
      }
    }
    guard let main = weights.indices.max(by: { weights[$0] < weights[$1] }), weights[main] > 0
    else { return nil }
    for component in weights.indices
    where members[component].count < options.minimumComponentSamples { weights[component] = 0 }
    var isPart = weights.map { $0 > 0 && $0 >= options.secondaryShare * weights[main] }
    isPart[main] = true
    try attach(&isPart, weights, members, indices, context.control)
    if let support, attachBase(&isPart, weights, members, indices, support) {
      try attach(&isPart, weights, members, indices, context.control)
    }
    var isObject = [Bool](repeating: false, count: cloud.count)
    for component in isPart.indices where isPart[component] {
      for member in members[component] { isObject[indices[Int(member)]] = true }
    }
    return isObject
  }

  /// Adds components near the object, round by round.
  private func attach(
    _ isPart: inout [Bool], _ weights: [Double], _ members: Members, _ indices: [Int],
    _ control: KernelControl
  ) throws {
    for _ in 0..<options.attachmentRounds {
      let (parts, others) = (
        isPart.indices.filter { isPart[$0] },
        isPart.indices.filter { !isPart[$0] && weights[$0] > 0 }
      )
      let object = parts.flatMap { members[$0] }.map { cloud.positions[indices[Int($0)]] }
      guard let bounds = Mesh(positions: object).bounds, !others.isEmpty else { return }
      let size = Double((bounds.max - bounds.min).length)
      let reach = max(
        options.minimumAttachment * cell * options.connectionSamples,
        options.attachmentDistance * size)
      let queries = others.flatMap { members[$0] }.map { cloud.positions[indices[Int($0)]] }
      let nearest = try NearestPoints(
        of: queries, in: object, maximumDistance: reach, control)
      var (cursor, isChanged) = (0, false)
      for component in others {
        let count = members[component].count
        if nearest.indices[cursor..<cursor + count].contains(where: { $0 >= 0 }) {
          isPart[component] = true
          isChanged = true
        }
        cursor += count
      }
      if !isChanged { return }
    }
  }

  /// An object does not float: if its lowest part is high above the support, components below it
  /// are its base. Returns whether there are any.
  private func attachBase(
    _ isPart: inout [Bool], _ weights: [Double], _ members: Members, _ indices: [Int],
    _ support: SupportPlane
  ) -> Bool {
    func positions(_ component: Int) -> [SIMD3<Double>] {
      members[component].map { SIMD3<Double>(cloud.positions[indices[Int($0)]]) }
    }
    let object = isPart.indices.filter { isPart[$0] }.flatMap(positions)
    guard let bounds = Mesh(positions: object.map { SIMD3<Float>($0) }).bounds,
      let lowest = object.map(support.height).quantile(options.baseQuantile)
    else { return false }
    let size = Double((bounds.max - bounds.min).length)
    guard lowest > options.attachmentDistance * size else { return false }
    let (u, v) = support.normal.orthonormalPair
    let middle = object.reduce(.zero, +) / Double(object.count)
    let reach = object.map { hypot(($0 - middle).dot(u), ($0 - middle).dot(v)) }.max() ?? 0
    var isChanged = false
    for component in isPart.indices where !isPart[component] && weights[component] > 0 {
      let part = positions(component)
      let isUnder = part.allSatisfy {
        hypot(($0 - middle).dot(u), ($0 - middle).dot(v)) <= reach
      }
      let top = part.map(support.height).quantile(1 - options.baseQuantile) ?? .infinity
      if isUnder, top <= lowest + options.attachmentDistance * size {
        isPart[component] = true
        isChanged = true
      }
    }
    return isChanged
  }

  /// The length along which the object continues beyond the region of interest, relative to the
  /// circumference of a disc of the object's area.
  private func truncation(_ isObject: [Bool], _ isAbove: [Bool], _ control: KernelControl) throws
    -> Double
  {
    let object = cloud.positions.indices.filter { isObject[$0] }
    let beyond = cloud.positions.indices.filter {
      isAbove[$0] && !isObject[$0]
        && (Double(coverage[$0]) < options.objectCoverage || Double(distance[$0]) >= options.reach)
    }
    guard !object.isEmpty, !beyond.isEmpty else { return 0 }
    let nearest = try NearestPoints(
      of: object.map { cloud.positions[$0] }, in: beyond.map { cloud.positions[$0] },
      maximumDistance: options.contactSamples * cell, control)
    let touching = nearest.indices.filter { $0 >= 0 }.count
    return Double(touching) / (2 * (Double.pi * Double(object.count)).squareRoot())
  }
}
