import SceneModel
import Testing

@Suite struct OrientedBoxTests {
  @Test func cornersGiveCenterAndExtents() {
    let box = OrientedBox(min: [-1, 0, 2], max: [3, 2, 8])
    #expect(box.center == [1, 1, 5] && box.halfExtents == [2, 1, 3] && box.rotation == .identity)
    #expect(box.axes == [[1, 0, 0], [0, 1, 0], [0, 0, 1]])
  }

  @Test func axesTurnWithTheBox() {
    let box = OrientedBox(
      center: .zero, halfExtents: [1, 2, 3],
      rotation: Quaternion(angle: .pi / 2, axis: [0, 0, 1]))
    for (axis, expected) in zip(box.axes, [SIMD3<Float>(0, 1, 0), [-1, 0, 0], [0, 0, 1]]) {
      #expect((axis - expected).length < 1e-6)
    }
  }

  @Test func growthIsOnAllSides() {
    let box = OrientedBox(center: [1, 2, 3], halfExtents: [1, 2, 3]).grown(by: 0.5)
    #expect(box == OrientedBox(center: [1, 2, 3], halfExtents: [1.5, 2.5, 3.5]))
  }
}
