import Kernels
import SceneModel

/// The files of a workspace that the dense stage must compute; valid existing files are reused.
///
/// Resolved backwards from the cloud, so that inputs of finished steps are not checked.
struct DensePlan: Sendable {
  /// Indices of views, ascending, by step.
  private(set) var missing: [PatchWorkspace.Step: [Int]] = [:]

  /// Plans what `target` requires for the given views; for all views if `indices` is nil.
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

  /// Indices of the views that lack the file of `step`.
  subscript(step: PatchWorkspace.Step) -> [Int] { missing[step] ?? [] }

  /// Whether the views have the sparse points that missing files are computed from.
  func isFeasible(for views: DenseViews) -> Bool {
    self[.coarse].allSatisfy { views.points[$0] != nil }
  }

  /// Approximate size of the missing files in bytes.
  func byteCount(_ views: DenseViews) -> Int {
    missing.reduce(0) { sum, entry in
      sum + entry.value.reduce(0) { $0 + views.views[$1].pixelCount } * entry.key.bytesPerPixel
    }
  }

  /// The views whose file is missing or invalid. Reads each file in full, so that damage is
  /// detected before any work starts.
  private static func absent(
    _ step: PatchWorkspace.Step, _ indices: [Int], _ views: DenseViews,
    _ workspace: PatchWorkspace, _ control: KernelControl
  ) throws -> [Int] {
    let isValid = try control.parallelUnits(indices.count) { index, _ in
      workspace.contains(views.key(step, indices[index]))
    }
    return zip(indices, isValid).filter { !$0.1 }.map(\.0)
  }
}

extension PatchWorkspace.Step {
  /// Bytes of a file per pixel of its view; for the cloud, an estimate above the usual size.
  fileprivate var bytesPerPixel: Int {
    switch self {
    case .view: 3
    case .coarse, .coarseCompleted: 4
    case .patches, .completed, .cloud: 16
    case .coarseStates, .states, .completedStates: 1
    }
  }
}

extension DetailSpecification {
  /// Approximate size of the temporary files of a run in bytes per photo.
  package var workspaceBytesPerPhoto: Int {
    viewPixels * PatchWorkspace.Step.allCases.reduce(0) { $0 + $1.bytesPerPixel }
  }
}
