import Foundation
import RealityKit

/// Boxes and transforms.
func useGeometry() throws {
  var box = BoundingBox()
  check(box.isEmpty && box == BoundingBox.empty, "a new box is empty")
  box.formUnion(SIMD3<Float>(1, 2, 3))
  box.formUnion(BoundingBox(min: .zero, max: .one))
  check(box.union(SIMD3<Float>.zero) == box.union(box), "unions")
  check(box.min == .zero && box.max == [1, 2, 3] && box.center == [0.5, 1, 1.5], "corners")
  check(box.extents == [1, 2, 3] && box.boundingRadius > 1.8, "extents")
  check(box.contains(SIMD3<Float>(0.5, 1, 1)) && box.contains(box), "contains")
  check(box.intersects(box) && box.distanceSquared(toPoint: [2, 2, 3]) == 1, "distance")
  var moved = box
  var shift = Transform()
  shift.translation = [1, 0, 0]
  moved.transform(by: shift.matrix)
  check(moved == box.transformed(by: shift.matrix) && moved.min.x == 1, "transformed")
  let data = try JSONEncoder().encode([box, moved])
  check(try JSONDecoder().decode([BoundingBox].self, from: data) == [box, moved], "coded")
  check(Transform(matrix: shift.matrix) == shift && Transform.identity != shift, "matrices")
  let turn = Transform(pitch: 0, yaw: .pi, roll: 0)
  check(abs(turn.rotation.angle - .pi) < 1e-5 && turn.scale == .one, "turns")
  check(OrientedBoundingBox().boundingBox.isEmpty, "no box")
}
