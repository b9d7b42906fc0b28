import Foundation
import SceneModel

/// Points, cameras and observations with known ground truth, without pixels.
///
/// The object is a ball of radius 1 at the origin, or a disk of radius 2 in the plane y = 0; +y is
/// up. Points of the ball are visible if they face the camera.
package struct SyntheticScene: Sendable {
  /// The arrangement of the cameras.
  package enum Layout: String, Sendable, CaseIterable {
    /// A full circle around the object, facing its center.
    case ring
    /// An arc of 100° of the circle.
    case arc
    /// A straight line past the object, with parallel optical axes.
    case line
  }

  package struct Options: Sendable {
    package var layout = Layout.ring
    package var photoCount = 12
    package var pointCount = 800
    /// Distributes the points on a plane instead of the ball.
    package var isPlanar = false
    /// Standard deviation of the keypoints in pixels.
    package var pixelNoise = 0.0
    /// Fraction of wrong matches among the matches of a pair, 0..<1.
    package var outlierRatio = 0.0
    /// Rotates the relative poses in the view graph about a random axis by this angle in radians.
    package var relativePoseNoise = 0.0
    /// Pairs with fewer common points are not part of the view graph.
    package var minimumMatches = 15
    /// Index of the first photo of another object; photos from there on share nothing with those
    /// before.
    package var secondComponentStart: Int?
    package var camera = Camera(
      width: 1600, height: 1200, focalLength: [1400, 1400], principalPoint: [800, 600])
    package var seed: UInt64 = 1

    package init() {}
  }

  package let options: Options
  /// The true camera.
  package let camera: Camera
  package let photos: [Photo]
  /// The true `cameraFromWorld`.
  package let poses: [RigidTransform]
  package let points: [SIMD3<Double>]
  /// Keypoints with noise, in random order.
  package let features: [FeatureSet]
  /// The point of every feature.
  package let pointOfFeature: [[Int32]]
  package let viewGraph: ViewGraph

  package init(_ options: Options = Options()) {
    var random = SeededGenerator(seed: options.seed)
    self.options = options
    camera = options.camera
    let poses = Self.makePoses(options)
    let points = Self.makePoints(options, &random)
    self.poses = poses
    self.points = points
    photos = (0..<options.photoCount).map { index in
      let name = String(format: "photo%03d.jpg", index)
      return Photo(
        id: ID(index), sampleID: index, name: name, url: URL(fileURLWithPath: "/" + name),
        width: options.camera.width, height: options.camera.height, orientation: 1,
        camera: ID<Camera>(0))
    }
    let descriptors = points.map { _ in Self.makeDescriptor(&random) }
    var features: [FeatureSet] = []
    var pointOfFeature: [[Int32]] = []
    for photo in 0..<options.photoCount {
      let seen = Self.visiblePoints(photo, points, poses[photo], options).shuffled(using: &random)
      features.append(
        Self.makeFeatures(seen.map { points[$0] }, poses[photo], options, &random))
      features[photo].descriptors = seen.flatMap { descriptors[$0] }
      pointOfFeature.append(seen.map(Int32.init))
    }
    self.features = features
    self.pointOfFeature = pointOfFeature
    viewGraph = Self.makeViewGraph(features, pointOfFeature, points, poses, options, &random)
  }

  /// The result of a perfect alignment, in the world frame of the scene.
  package var reconstruction: Reconstruction {
    var tracks = [[Observation]](repeating: [], count: points.count)
    for photo in photos.indices {
      for (feature, point) in pointOfFeature[photo].enumerated() {
        tracks[Int(point)].append(
          Observation(
            photo: ID(photo), feature: Int32(feature),
            pixel: SIMD2<Double>(features[photo].positions[feature])))
      }
    }
    let scenePoints = zip(points, tracks).filter { $0.1.count >= 2 }
      .map { ScenePoint(position: $0.0, color: [128, 128, 128], track: $0.1) }
    return Reconstruction(cameras: [camera], photos: photos, poses: poses, points: scenePoints)
  }
}

extension SyntheticScene {
  private static func makePoses(_ options: Options) -> [RigidTransform] {
    let count = options.photoCount
    return (0..<count).map { index in
      switch options.layout {
      case .ring: orbit(2 * .pi * Double(index) / Double(count))
      case .arc: orbit((Double(index) / Double(max(1, count - 1)) - 0.5) * 100 * .pi / 180)
      case .line:
        RigidTransform.lookingAt(
          [Double(index) * 0.35 - 0.175 * Double(count - 1), 1.2, 4.5],
          from: [Double(index) * 0.35 - 0.175 * Double(count - 1), 1.6, 5.5])
      }
    }
  }

  private static func orbit(_ angle: Double) -> RigidTransform {
    let (height, distance) = (1 + 0.4 * sin(3 * angle), 3 + 0.5 * sin(2 * angle))
    return RigidTransform.lookingAt(
      [0, 0, 0], from: [distance * sin(angle), height, distance * cos(angle)])
  }

  private static func makePoints(
    _ options: Options, _ random: inout SeededGenerator
  ) -> [SIMD3<Double>] {
    (0..<options.pointCount).map { _ in
      if options.isPlanar {
        let (radius, angle) = (2 * random.uniform().squareRoot(), 2 * .pi * random.uniform())
        return [radius * cos(angle), 0, radius * sin(angle)]
      }
      let direction = random.normal3().normalized
      let radius = 1 + 0.1 * random.uniform()
      // A line of cameras needs an object as long as the line.
      return options.layout == .line
        ? [direction.x * (1 + 0.2 * Double(options.photoCount)), direction.y, direction.z] * radius
        : direction * radius
    }
  }

  private static func visiblePoints(
    _ photo: Int, _ points: [SIMD3<Double>], _ pose: RigidTransform, _ options: Options
  ) -> [Int] {
    points.indices.filter { index in
      let point = points[index]
      if let start = options.secondComponentStart, (index % 2 == 0) != (photo < start) {
        return false
      }
      let normal: SIMD3<Double> = options.layout == .line ? [0, 0, point.z] : point
      if !options.isPlanar, normal.normalized.dot((pose.center - point).normalized) < 0.15 {
        return false
      }
      let inCamera = pose * point
      guard inCamera.z > 0.1 else { return false }
      let pixel = options.camera.project(inCamera)
      return pixel.x > 0 && pixel.y > 0 && pixel.x < Double(options.camera.width)
        && pixel.y < Double(options.camera.height)
    }
  }

  private static func makeFeatures(
    _ points: [SIMD3<Double>], _ pose: RigidTransform, _ options: Options,
    _ random: inout SeededGenerator
  ) -> FeatureSet {
    FeatureSet(
      positions: points.map { point in
        let pixel = options.camera.project(pose * point)
        let (x, y) = (random.normal(), random.normal())
        return SIMD2<Float>(pixel + options.pixelNoise * SIMD2(x, y))
      },
      scales: points.map { _ in 2 }, orientations: points.map { _ in 0 },
      colors: points.map { _ in [128, 128, 128] })
  }

  private static func makeDescriptor(_ random: inout SeededGenerator) -> [UInt8] {
    let values = (0..<FeatureSet.descriptorLength).map { _ in random.uniform() * random.uniform() }
    let length = values.reduce(0) { $0 + $1 * $1 }.squareRoot()
    return values.map { UInt8(min(255, 512 * $0 / length)) }
  }

  private static func makeViewGraph(
    _ features: [FeatureSet], _ pointOfFeature: [[Int32]], _ points: [SIMD3<Double>],
    _ poses: [RigidTransform], _ options: Options, _ random: inout SeededGenerator
  ) -> ViewGraph {
    var pairs: [VerifiedPair] = []
    for first in features.indices {
      for second in features.indices where second > first {
        var featureOfPoint: [Int32: Int32] = [:]
        for (feature, point) in pointOfFeature[second].enumerated() {
          featureOfPoint[point] = Int32(feature)
        }
        var matches: [FeatureMatch] = []
        var angles: [Double] = []
        for (feature, point) in pointOfFeature[first].enumerated() {
          guard let other = featureOfPoint[point] else { continue }
          if random.uniform() < options.outlierRatio {
            let wrong = Int32.random(in: 0..<Int32(features[second].count), using: &random)
            matches.append(FeatureMatch(first: Int32(feature), second: wrong))
          } else {
            matches.append(FeatureMatch(first: Int32(feature), second: other))
          }
          let rays = [first, second].map { (points[Int(point)] - poses[$0].center).normalized }
          angles.append(acos(min(1, rays[0].dot(rays[1]))))
        }
        guard matches.count >= options.minimumMatches else { continue }
        var relative = poses[second] * poses[first].inverse
        let tilt = Quaternion(angle: options.relativePoseNoise, axis: random.normal3())
        relative.rotation = (tilt * relative.rotation).normalized
        relative.translation = relative.translation.normalized
        pairs.append(
          VerifiedPair(
            pair: PhotoPair(ID(first), ID(second)),
            model: options.isPlanar ? .homography : .essential,
            secondFromFirst: relative, matches: matches,
            medianAngle: angles.sorted()[angles.count / 2]))
      }
    }
    return ViewGraph(photoCount: features.count, pairs: pairs)
  }
}
