/// A step of the dense stage whose results for one view need those of the step before for others.
package enum DensePart: String, CaseIterable, Hashable, Sendable {
  case coarse, coarseCompleted, patches, completed, cloud

  /// Relative cost per view. Chosen: those of `DenseSteps`, with the steps in between.
  package var cost: Double {
    switch self {
    case .coarse: 0.16
    case .coarseCompleted: 0.08
    case .patches: 0.35
    case .completed: 0.25
    case .cloud: 0.16
    }
  }

  var step: PatchWorkspace.Step {
    switch self {
    case .coarse: .coarse
    case .coarseCompleted: .coarseCompleted
    case .patches: .patches
    case .completed: .completed
    case .cloud: .cloud
    }
  }
}
