import Kernels
import SceneModel

/// Which files of a workspace the dense stage has to make: what is there already stays.
///
/// Goes backwards from the cloud, so that no step looks for what a later one no longer needs.
struct DensePlan: Sendable {
  /// Positions of views, ascending, by step.
  private(set) var missing: [PatchWorkspace.Step: [Int]] = [:]

  /// What the cloud needs.
  init(cloudOf views: DenseViews, _ workspace: PatchWorkspace, _ control: KernelControl) throws {
    let all = Array(views.indices)
    let clouds = try Self.absent(.cloud, all, views, workspace, control)
    let states = try Self.absent(.states, views.withSources(clouds), views, workspace, control)
    let needed = views.withSources(clouds) + views.withSources(states)
    missing = [.cloud: clouds, .states: states]
    try addPatches(Set(needed).sorted(), views, workspace, control)
  }

  /// What the patches of some views need.
  init(
    patchesOf indices: [Int], _ views: DenseViews, _ workspace: PatchWorkspace,
    _ control: KernelControl
  ) throws {
    try addPatches(indices, views, workspace, control)
  }

  subscript(step: PatchWorkspace.Step) -> [Int] { missing[step] ?? [] }

  /// Bytes that the missing files take, about.
  func byteCount(_ views: DenseViews) -> Int {
    missing.reduce(0) { sum, entry in
      sum + entry.value.reduce(0) { $0 + views.views[$1].pixelCount } * entry.key.bytesPerPixel
    }
  }

  private mutating func addPatches(
    _ indices: [Int], _ views: DenseViews, _ workspace: PatchWorkspace, _ control: KernelControl
  ) throws {
    let patches = try Self.absent(.patches, indices, views, workspace, control)
    let needed = Set(indices + views.withSources(patches)).sorted()
    missing[.patches] = patches
    missing[.view] = try Self.absent(.view, needed, views, workspace, control)
  }

  /// The views whose file can't be used; reads all of it, so that damage is found before the work.
  private static func absent(
    _ step: PatchWorkspace.Step, _ indices: [Int], _ views: DenseViews,
    _ workspace: PatchWorkspace, _ control: KernelControl
  ) throws -> [Int] {
    let isThere = try control.parallelUnits(indices.count) { index, _ in
      workspace.bytes(views.key(step, indices[index])) != nil
    }
    return zip(indices, isThere).filter { !$0.1 }.map(\.0)
  }
}

extension PatchWorkspace.Step {
  /// What a file takes for each pixel of its view; the cloud's is a guess above what is usual.
  fileprivate var bytesPerPixel: Int {
    switch self {
    case .view: 3
    case .patches: 16
    case .states: 1
    case .cloud: 16
    }
  }
}
