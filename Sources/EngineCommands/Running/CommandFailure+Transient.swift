import Kernels
import Pipeline
import RealityFoundation
import SharedCommands

extension CommandFailure {
  /// The failure of a run of this project's engine.
  init(engineError error: any Error) {
    self.init(error, isTransient: Self.isTransient(error))
  }

  /// Whether another attempt may succeed after `error`: memory or the checkpoint directory may be
  /// free then.
  static func isTransient(_ error: any Error) -> Bool {
    switch error {
    case let error as ProcessingError: [.outOfMemory, .checkpointUnusable].contains(error.code)
    case KernelError.outOfMemory, CheckpointError.inUse: true
    default: false
    }
  }
}
