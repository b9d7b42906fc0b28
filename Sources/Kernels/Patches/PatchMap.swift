import CKernels

/// The patches of one view, and which of them the filter accepted. Immutable.
package final class PatchMap: Sendable {
  /// The view that the patches belong to.
  package let view: PatchView
  private let patches: FrozenArray<ck_patch>
  /// The result of the filter; nil for an unfiltered map.
  package let states: PatchStates?

  init(
    view: PatchView, patches: FrozenArray<ck_patch>, states: PatchStates? = nil
  ) {
    (self.view, self.patches, self.states) = (view, patches, states)
  }

  /// A map whose patches `fill` writes to the given buffer, in the layout of `withPatchBytes`.
  package convenience init(
    view: PatchView, states: PatchStates? = nil,
    fill: (UnsafeMutableRawBufferPointer) throws -> Void
  ) rethrows {
    let patches = try FrozenArray<ck_patch>(count: view.width * view.height) {
      try fill(UnsafeMutableRawBufferPointer($0))
    }
    self.init(view: view, patches: patches, states: states)
  }

  /// The map with the result of `PatchStereo.filter`.
  package func filtered(_ states: PatchStates) -> PatchMap {
    PatchMap(view: view, patches: patches, states: states)
  }

  var count: Int { view.width * view.height }

  /// The C map, valid as long as this object lives.
  var raw: ck_patch_map {
    ck_patch_map(
      photo: Int32(view.photo.index), view: view.raw, rgb: view.rgb?.base, patches: patches.base,
      states: states?.states.base, visibility: states?.visibility?.base)
  }

  /// Calls `body` with all patches in memory layout and native byte order, valid only during the
  /// call.
  package func withPatchBytes<Result>(
    _ body: (UnsafeRawBufferPointer) throws -> Result
  ) rethrows -> Result {
    try withExtendedLifetime(self) { try body(UnsafeRawBufferPointer(patches.elements)) }
  }

  /// Bytes per pixel of a map and its view.
  package static let bytesPerPixel = MemoryLayout<ck_patch>.stride + 5

  /// The patch at column `x`, row `y`.
  package subscript(x: Int, y: Int) -> Patch { Patch(patches.elements[y * view.width + x]) }

  /// Number of patches that passed the filter; 0 for an unfiltered map.
  package var acceptedCount: Int { states?.acceptedCount ?? 0 }

  /// Whether the filter accepted the patch at column `x`, row `y`; false for an unfiltered map.
  package func isAccepted(_ x: Int, _ y: Int) -> Bool {
    states.map { $0.states.elements[y * view.width + x] != 0 } ?? false
  }
}
