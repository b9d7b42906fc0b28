import Dispatch
import Synchronization
import SceneModel

/// Maps contiguous ranges that cover `0..<count` on multiple threads and concatenates the results
/// in order. The size of a range is chosen.
func parallelChunks<Element: Sendable>(
  _ count: Int, threads: Int, size chunkSize: Int = 4096,
  _ body: @Sendable (Range<Int>) -> [Element]
) -> [Element] {
  let chunks = (count + chunkSize - 1) / chunkSize
  let results = Locked([[Element]](repeating: [], count: chunks))
  let next = Atomic<Int>(0)
  DispatchQueue.concurrentPerform(iterations: max(1, min(threads, chunks))) { _ in
    while true {
      let chunk = next.add(1, ordering: .relaxed).oldValue
      guard chunk < chunks else { return }
      let result = body((chunk * chunkSize)..<min(count, (chunk + 1) * chunkSize))
      results.withLock { $0[chunk] = result }
    }
  }
  return results.withLock { $0.flatMap { $0 } }
}
