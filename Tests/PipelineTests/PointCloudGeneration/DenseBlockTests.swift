import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

/// Steps of the dense stage for blocks of the views.
@Suite struct DenseBlockTests {
  private let scene = RaycastScene()
  private let generation = PointCloudGeneration()
  private var images: ImageStore { ImageStore(images: scene.views.map(\.image)) }

  private func make(
    _ step: PatchWorkspace.Step, _ block: Block, of views: DenseViews, in folder: URL
  ) throws -> Bool {
    try generation.make(
      step, block, of: views, scene.reconstruction, images: images, folder: folder, StageContext())
  }

  /// As another process reads them.
  private func withoutPoints(_ views: DenseViews) -> DenseViews {
    DenseViews(views.views, views.fingerprints)
  }

  @Test func onlyTheFirstStepNeedsSparsePoints() throws {
    let views = try DenseViews(
      scene.reconstruction, images: images, options: generation.options, KernelControl())
    let (folder, blocks) = (try TemporaryFolder(), 2)
    let stored = withoutPoints(views)
    #expect(try !make(.cloud, Block(index: 0, of: blocks), of: stored, in: folder.url))
    for index in 0..<blocks {
      #expect(try make(.coarse, Block(index: index, of: blocks), of: views, in: folder.url))
    }
    for index in 0..<blocks {
      #expect(try make(.cloud, Block(index: index, of: blocks), of: stored, in: folder.url))
    }
    let fused = try generation.fusedViews(
      of: stored, scene.reconstruction, images: images, folder: folder.url, KernelControl()
    ) {
      Issue.record("No sparse points are needed.")
      return views
    }
    var cloud = PointCloud()
    for view in 0..<fused.count { cloud.append(try fused.points(view)) }
    let whole = try generation.run(scene.reconstruction, images: images, StageContext())
    #expect(cloud.positions == whole.positions && cloud.count > 3000)
  }

  @Test func damagedViewsAreMadeAgain() throws {
    let views = try DenseViews(
      scene.reconstruction, images: images, options: generation.options, KernelControl())
    let folder = try TemporaryFolder()
    var uses = 0
    let fused = try generation.fusedViews(
      of: withoutPoints(views), scene.reconstruction, images: images, folder: folder.url,
      KernelControl()
    ) {
      uses += 1
      return views
    }
    #expect(try fused.points(0).count > 100)
    #expect(uses == 1)
    #expect(try fused.points(0).count > 100)
    #expect(uses == 1)
  }
}
