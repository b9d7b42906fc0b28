import Foundation
import Kernels
import SceneModel
import TestSupport

@testable import Pipeline

/// Clouds of known shapes with cameras around them: exact positions, normals and visibility.
struct IsolationScene {
  /// Side of a surface element, world units.
  var spacing = 0.02
  var cameraDistance = 3.0
  /// Cameras on two rings; those of the upper one look down more steeply.
  var photoCount = 16
  private(set) var cloud = PointCloud()
  /// The label of each point, as passed to `add`.
  private(set) var labels: [Int] = []

  /// The cameras are aimed at `target`.
  func reconstruction(target: SIMD3<Double> = [0, 0.4, 0], arc: Double = 2 * .pi) -> Reconstruction
  {
    let camera = Camera(width: 800, height: 600, focalLength: [900, 900])
    let photos = (0..<photoCount).map { index in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
        width: 800, height: 600, orientation: 1, camera: ID<Camera>(0))
    }
    let poses = (0..<photoCount).map { index -> RigidTransform? in
      let angle = arc * Double(index) / Double(photoCount)
      let elevation = index % 2 == 0 ? 0.35 : 0.9
      let direction = SIMD3(
        cos(angle) * cos(elevation), sin(elevation), sin(angle) * cos(elevation))
      return RigidTransform.lookingAt(target, from: target + cameraDistance * direction)
    }
    return Reconstruction(
      cameras: [camera], photos: photos, poses: poses, points: [],
      worldFrame: WorldFrame(scale: .arbitrary, up: .supportPlane))
  }

  /// Adds a point that every photo on its side of the surface sees.
  mutating func add(
    _ position: SIMD3<Double>, normal: SIMD3<Double>, label: Int, centers: [SIMD3<Double>]
  ) {
    let photos = centers.indices.filter { (centers[$0] - position).dot(normal) > 0 }
    guard photos.count >= 2 else { return }
    cloud.positions.append(SIMD3<Float>(position))
    cloud.normals.append(SIMD3<Float>(normal))
    cloud.colors.append([200, 100, 50])
    cloud.consistency.append(0.9)
    cloud.footprints.append(Float(spacing))
    cloud.photoIndices.append(contentsOf: photos.map(UInt16.init))
    cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    labels.append(label)
  }

  /// Evenly spaced points of a ball; `keeps` selects a part of it.
  mutating func addBall(
    center: SIMD3<Double>, radius: Double, label: Int, centers: [SIMD3<Double>],
    keeps: (SIMD3<Double>) -> Bool = { _ in true }
  ) {
    let count = Int(4 * .pi * radius * radius / (spacing * spacing))
    for index in 0..<count {
      let y = 1 - 2 * (Double(index) + 0.5) / Double(count)
      let angle = Double(index) * .pi * (3 - 5.0.squareRoot())
      let r = (1 - y * y).squareRoot()
      let normal = SIMD3(r * cos(angle), y, r * sin(angle))
      let position = center + radius * normal
      if keeps(position) { add(position, normal: normal, label: label, centers: centers) }
    }
  }

  /// Points of the plane `normal · x = 0` within `radius` of its origin, with slight relief.
  mutating func addPlane(
    normal: SIMD3<Double> = [0, 1, 0], radius: Double, label: Int, centers: [SIMD3<Double>],
    keeps: (SIMD3<Double>) -> Bool = { _ in true }
  ) {
    var random = SeededGenerator(seed: 3)
    let (u, v) = normal.orthonormalPair
    let steps = Int(radius / spacing)
    for i in -steps...steps {
      for j in -steps...steps where i * i + j * j <= steps * steps {
        let position =
          spacing * (Double(i) * u + Double(j) * v)
          + 0.1 * spacing * (random.uniform() - 0.5) * normal
        if keeps(position) { add(position, normal: normal, label: label, centers: centers) }
      }
    }
  }
}
