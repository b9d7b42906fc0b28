import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// Filtering and fusion of exact patches of a scene with known depth.
@Suite struct PatchVisibilityTests {
  static let scene = RaycastScene()

  /// Maps with the true depth and slope of every pixel.
  static func exactMaps(_ scene: RaycastScene = scene) -> [PatchMap] {
    scene.views.indices.map { view in
      var map = PatchMapBuilder(view: PatchView(scene.views[view]))
      let camera = scene.views[view].camera
      for y in 0..<camera.height {
        for x in 0..<camera.width {
          guard let depth = scene.depth(view, x, y), let normal = scene.normal(view, x, y) else {
            continue
          }
          map[x, y] = patch(scene.views[view], x, y, depth, normal)
        }
      }
      return map.finished()
    }
  }

  /// The tangent plane of a surface over the pixel grid: w(p) = n · K⁻¹p / (n · X).
  static func patch(
    _ view: PinholeView, _ x: Int, _ y: Int, _ depth: Double, _ normal: SIMD3<Double>
  ) -> Patch {
    let center = view.camera.unproject(SIMD2(Double(x) + 0.5, Double(y) + 0.5))
    let right = view.camera.unproject(SIMD2(Double(x) + 1.5, Double(y) + 0.5))
    let below = view.camera.unproject(SIMD2(Double(x) + 0.5, Double(y) + 1.5))
    let n = view.cameraFromWorld.rotation * normal
    let scale = 1 / (depth * n.dot(SIMD3(center.x, center.y, 1)))
    return Patch(
      inverseDepth: Float(1 / depth),
      gradient: [
        Float(scale * n.x * (right.x - center.x)), Float(scale * n.y * (below.y - center.y)),
      ], cost: 0.05)
  }

  @Test func exactPatchesVisibleInThreeViewsAreKept() throws {
    let maps = try PatchStereoTests.filtered(Self.exactMaps())
    var (seen, kept) = (0, 0)
    for y in 30..<90 {
      for x in 40..<120 where maps[2][x, y].inverseDepth > 0 {
        seen += 1
        kept += maps[2].isAccepted(x, y) ? 1 : 0
      }
    }
    #expect(Double(kept) > 0.9 * Double(seen))
    // The sky has no patches.
    #expect(
      maps[2].acceptedCount
        <= (0..<120).reduce(0) { sum, y in
          sum + (0..<160).filter { Self.scene.depth(2, $0, y) != nil }.count
        })
  }

  @Test func fusedPointsLieOnTheSurface() throws {
    let cloud = try PatchStereoTests.fused(Self.exactMaps())
    #expect(cloud.count > 5000)
    let distances = cloud.positions.map { Self.scene.distance(to: SIMD3<Double>($0)) }.sorted()
    // A tangent plane deviates from the ball by a fraction of a pixel.
    #expect(distances[cloud.count * 95 / 100] < 0.0005)
    #expect(distances[cloud.count / 2] < 0.0001)
    var errors: [Double] = []
    for index in 0..<cloud.count {
      let (p, n) = (SIMD3<Double>(cloud.positions[index]), SIMD3<Double>(cloud.normals[index]))
      errors.append(acos(min(1, n.dot(p.y < -1.19 ? [0, 1, 0] : p.normalized))) * 180 / .pi)
    }
    #expect(errors.sorted()[cloud.count * 9 / 10] < 1)
  }

  @Test func surfaceElementsAreFusedOnce() throws {
    let maps = try PatchStereoTests.filtered(Self.exactMaps())
    let cloud = try PatchStereoTests.fused(maps)
    // Five views from about the same distance show nearly the same surface: one point per view
    // would be several times the patches of one view.
    let largest = maps.map(\.acceptedCount).max() ?? 0
    #expect(Double(cloud.count) < 2 * Double(largest))
    #expect(cloud.count >= largest / 2)
  }

  @Test func neighborOrderDoesNotMatter() throws {
    let maps = try PatchStereoTests.filtered(Self.exactMaps())
    let options = PatchStereo.FilterOptions()
    for index in maps.indices {
      let others = PatchStereoTests.others(maps, index)
      let expected = try PatchStereo.fuse(
        maps[index], neighbors: others, options: options, control: KernelControl())
      let reversed = try PatchStereo.fuse(
        maps[index], neighbors: others.reversed(), options: options, control: KernelControl())
      #expect(expected.positions == reversed.positions)
      #expect(expected.colors == reversed.colors)
      #expect(expected.photoIndices == reversed.photoIndices)
    }
  }

  @Test(arguments: Instructions.allCases.filter(\.isSupported))
  func instructionSetsAgree(_ instructions: Instructions) throws {
    func accepted(_ instructions: Instructions) throws -> [Bool] {
      let maps = Self.exactMaps()
      var options = PatchStereo.FilterOptions()
      options.instructions = instructions
      return try maps.indices.flatMap { index in
        let map = maps[index].filtered(
          try PatchStereo.filter(
            maps[index], neighbors: PatchStereoTests.others(maps, index), options: options,
            control: KernelControl()))
        return (0..<120).flatMap { y in (0..<160).map { map.isAccepted($0, y) } }
      }
    }
    let expected = try accepted(.portable)
    let different = zip(expected, try accepted(instructions)).filter { $0 != $1 }.count
    #expect(expected.filter { $0 }.count > 20000)
    #expect(different < 20)
  }
}
