/// The result of the filter for each patch of a view. Immutable.
package struct PatchStates: Sendable {
  let states: FrozenArray<UInt8>
  /// Bit mask of the neighbors that confirm each patch, in the order given to the filter; nil
  /// unless `filter` recorded it.
  let visibility: FrozenArray<UInt8>?

  init(states: FrozenArray<UInt8>, visibility: FrozenArray<UInt8>? = nil) {
    (self.states, self.visibility) = (states, visibility)
  }

  /// States that `fill` writes to the given buffer, in the layout of `withBytes`.
  package init(
    view: PatchView, fill: (UnsafeMutableRawBufferPointer) throws -> Void
  ) rethrows {
    states = try FrozenArray(count: view.width * view.height) {
      try fill(UnsafeMutableRawBufferPointer($0))
    }
    visibility = nil
  }

  /// Number of patches that passed the filter.
  package var acceptedCount: Int { states.elements.reduce(0) { $0 + ($1 != 0 ? 1 : 0) } }

  /// Calls `body` with one byte per patch, valid only during the call: 0 if rejected, otherwise the
  /// footprint class.
  package func withBytes<Result>(
    _ body: (UnsafeRawBufferPointer) throws -> Result
  ) rethrows -> Result {
    try withExtendedLifetime(states) { try body(UnsafeRawBufferPointer(states.elements)) }
  }
}
