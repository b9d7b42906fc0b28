import Dispatch
import Kernels
import SceneModel

/// Runs `work` while another thread runs `other`, or after it if the control has a single thread;
/// returns when both have ended. Throws the error of `work`, or else that of `other`.
@discardableResult
func beside<Value>(
  _ other: @escaping @Sendable () throws -> Void, _ control: KernelControl,
  _ work: () throws -> Value
) throws -> Value {
  guard control.threadCount > 1 else {
    try other()
    return try work()
  }
  let outcome = Locked(Result<Void, any Error>.success(()))
  let group = DispatchGroup()
  DispatchQueue.global().async(group: group) {
    let result = Result { try other() }
    outcome.withLock { $0 = result }
  }
  let value = Result { try work() }
  group.wait()
  let found = try value.get()
  try outcome.withLock { try $0.get() }
  return found
}
