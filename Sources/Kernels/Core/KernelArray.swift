import CKernels

/// Elements at a fixed address, for the pointers in C structs that are passed to kernels.
///
/// Must be kept alive during the call with `withExtendedLifetime`.
final class KernelArray<Element: BitwiseCopyable> {
  let elements: UnsafeMutableBufferPointer<Element>

  init(_ source: some Collection<Element>) {
    elements = .allocate(capacity: source.count)
    _ = elements.initialize(fromContentsOf: source)
  }

  deinit { elements.deallocate() }

  var count: Int { elements.count }
  var base: UnsafeMutablePointer<Element>? { elements.baseAddress }

  var mutableSpan: ck_mutable_span {
    ck_mutable_span(data: base, count: count, stride: MemoryLayout<Element>.stride)
  }
}
