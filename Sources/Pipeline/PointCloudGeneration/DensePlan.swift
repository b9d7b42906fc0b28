import Kernels
import SceneModel

/// Which files of a workspace the dense stage has to make: what is there already stays.
///
/// Goes backwards from the cloud, so that no step looks for what a later one no longer needs.
struct DensePlan: Sendable {
  /// Positions of views, ascending, by step.
  private(set) var missing: [PatchWorkspace.Step: [Int]] = [:]

  /// What a step needs of some views, all of them where none are named.
  init(
    _ target: PatchWorkspace.Step, of indices: [Int]? = nil, _ views: DenseViews,
    _ workspace: PatchWorkspace, _ control: KernelControl
  ) throws {
    var needed = [target: Set(indices ?? Array(views.indices))]
    for step in PatchWorkspace.Step.allCases.reversed() {
      guard let wanted = needed[step] else { continue }
      let absent = try Self.absent(step, wanted.sorted(), views, workspace, control)
      missing[step] = absent
      for input in step.inputs { needed[input, default: []].formUnion(views.withSources(absent)) }
    }
  }

  subscript(step: PatchWorkspace.Step) -> [Int] { missing[step] ?? [] }

  /// Bytes that the missing files take, about.
  func byteCount(_ views: DenseViews) -> Int {
    missing.reduce(0) { sum, entry in
      sum + entry.value.reduce(0) { $0 + views.views[$1].pixelCount } * entry.key.bytesPerPixel
    }
  }

  /// The views whose file can't be used; reads all of it, so that damage is found before the work.
  private static func absent(
    _ step: PatchWorkspace.Step, _ indices: [Int], _ views: DenseViews,
    _ workspace: PatchWorkspace, _ control: KernelControl
  ) throws -> [Int] {
    let isThere = try control.parallelUnits(indices.count) { index, _ in
      workspace.contains(views.key(step, indices[index]))
    }
    return zip(indices, isThere).filter { !$0.1 }.map(\.0)
  }
}

extension PatchWorkspace.Step {
  /// What a file takes for each pixel of its view; the cloud's is a guess above what is usual.
  fileprivate var bytesPerPixel: Int {
    switch self {
    case .view: 3
    case .coarse, .coarseCompleted: 4
    case .patches, .completed, .cloud: 16
    case .coarseStates, .states, .completedStates: 1
    }
  }
}
