import Foundation
import SceneModel

/// A matte black loudspeaker of 18 × 30 × 20 cm with rounded edges: hardly any texture but a
/// regular grille and an emblem on its front, a knob on its right side and two terminals on its
/// back.
///
/// Its frame has +y up and its origin below its middle; the front faces +z.
enum Loudspeaker {
  static let halfSize = SIMD3(0.09, 0.15, 0.1)

  /// - Parameter fineness: scales the number of triangles per side.
  static func mesh(fineness: Double = 1) -> Mesh {
    func cells(_ count: Int) -> Int { max(4, Int(Double(count) * fineness)) }
    var mesh = Mesh.roundedBox(halfSize: halfSize, radius: 0.009, cells: cells(60))
      .placed(at: [0, halfSize.y, 0])
    func append(_ part: Mesh, facing axis: SIMD3<Double>, at place: SIMD3<Double>) {
      let turn = Quaternion(angle: .pi / 2, axis: SIMD3(0, 1, 0).cross(axis))
      mesh.append(part.moved(by: RigidTransform(rotation: turn, translation: place)))
    }
    let knob = button(radius: 0.012, height: 0.015, columns: cells(64))
    append(knob, facing: [1, 0, 0], at: [halfSize.x - 0.002, 0.07, -0.045])
    let terminal = button(radius: 0.006, height: 0.018, columns: cells(48))
    for x in [-0.02, 0.02] {
      append(terminal, facing: [0, 0, -1], at: [x, 0.075, -halfSize.z + 0.002])
    }
    return mesh
  }

  /// A cylinder around the y axis whose upper edge is rounded.
  private static func button(radius r: Double, height h: Double, columns: Int) -> Mesh {
    Mesh.turned(
      [[0, 0], [r, 0], [r, 0.02 * h], [r, 0.8 * h], [0.9 * r, h], [0.8 * r, h], [0, h]],
      columns: columns, rows: columns)
  }
}

/// The colors of a `Loudspeaker` in its frame.
struct LoudspeakerTexture: SurfaceTexture {
  /// Distance of the holes of the grille in meters.
  private let pitch: Float = 0.006
  /// Radius of the holes.
  private let hole: Float = 0.0018
  private let emblemCenter: SIMD2<Float>
  private let emblemHalfAxes: SIMD2<Float>
  private let body: SolidTexture
  private let emblem: SolidTexture
  private let brass: SolidTexture

  init(seed: UInt64) {
    var random = SeededGenerator(seed: seed &* 131 &+ 17)
    func number() -> UInt32 { UInt32(truncatingIfNeeded: random.next()) }
    body = SolidTexture(
      palette: [[0.020, 0.020, 0.021], [0.032, 0.031, 0.031], [0.050, 0.048, 0.047]],
      wavelength: 0.04, octaves: 6, seed: number()
    ).withContrast(0.3)
    emblem = SolidTexture(
      palette: [[0.08, 0.08, 0.09], [0.62, 0.6, 0.55], [0.3, 0.05, 0.04], [0.75, 0.74, 0.7]],
      wavelength: 0.016, octaves: 3, seed: number(), contrast: 5)
    brass = SolidTexture(
      palette: [[0.16, 0.1, 0.04], [0.42, 0.29, 0.11], [0.6, 0.46, 0.22]], wavelength: 0.008,
      octaves: 4, seed: number())
    let (place, size) = (Float(random.uniform()), Float(random.uniform()))
    emblemCenter = [0.03 * (place - 0.5), 0.036]
    emblemHalfAxes = [0.02 + 0.006 * size, 0.009]
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    let half = SIMD3<Float>(Loudspeaker.halfSize)
    guard point.x < half.x + 1e-4, point.z > -half.z - 1e-4 else {
      return brass.color(at: point, footprint: footprint)
    }
    let color = body.color(at: point, footprint: footprint)
    // The grille and the emblem are on the plane part of the front.
    guard point.z > half.z - 1e-4 else { return color }
    let place = SIMD2(point.x, point.y)
    let badge = badge(at: place, footprint)
    let shown = color * grille(at: place, footprint)
    return badge > 0
      ? shown * (1 - badge) + emblem.color(at: point, footprint: footprint) * badge : shown
  }

  /// The fraction of a pixel that the emblem covers.
  private func badge(at place: SIMD2<Float>, _ footprint: Float) -> Float {
    let scaled = (place - emblemCenter) / emblemHalfAxes
    return coverage((scaled.squaredLength.squareRoot() - 1) * emblemHalfAxes.y, footprint)
  }

  /// The brightness of the grille relative to the front: its holes, on a lattice, are darker.
  private func grille(at place: SIMD2<Float>, _ footprint: Float) -> Float {
    let (low, high) = (SIMD2<Float>(-0.075, 0.06), SIMD2<Float>(0.075, 0.285))
    let outside = pointwiseMax(low - place, place - high).max()
    let inside = coverage(outside, footprint)
    guard inside > 0 else { return 1 }
    let position = (place - low) / pitch
    let fromHole = (position - position.rounded(.down) - 0.5) * pitch
    let mean = Float.pi * hole * hole / (pitch * pitch)
    let covered = coverage(fromHole.squaredLength.squareRoot() - hole, footprint)
    let holes = mean + (covered - mean) * resolved(pitch, 1.2 * footprint)
    // Its cloth is slightly brighter than the housing.
    return 1 + inside * (0.3 - 0.75 * holes)
  }
}
