import CKernels
import SceneModel

/// The patches of one view under construction, with a single owner. `finished()` transfers the
/// memory to an immutable map that threads may share.
package struct PatchMapBuilder: ~Copyable {
  /// The view that the patches belong to.
  package let view: PatchView
  private var memory: UniqueArray<ck_patch>

  /// A map without patches.
  package init(view: PatchView) {
    self.view = view
    memory = UniqueArray(repeating: .none, count: view.width * view.height)
  }

  /// A mutable copy of the patches of a finished map.
  package init(copying map: PatchMap) {
    self.init(view: map.view)
    map.withPatchBytes { UnsafeMutableRawBufferPointer(patches).copyMemory(from: $0) }
  }

  /// The immutable map; its patches are not filtered.
  package consuming func finished() -> PatchMap {
    let view = view
    return PatchMap(view: view, patches: memory.frozen())
  }

  /// The patches at a fixed address, valid as long as the builder lives.
  var patches: UnsafeMutableBufferPointer<ck_patch> { memory.elements }

  /// The patch at column `x`, row `y`.
  package subscript(x: Int, y: Int) -> Patch {
    get { Patch(patches[y * view.width + x]) }
    set { memory.elements[y * view.width + x] = ck_patch(newValue) }
  }

  /// Removes the patches of pixels below `least` in a mask, gray and of the view's size. Throws
  /// `KernelError.invalidArgument` for another mask.
  package mutating func removePatches(outside mask: RasterImage, least: UInt8 = 128) throws {
    guard (mask.width, mask.height, mask.channels) == (view.width, view.height, 1) else {
      throw KernelError.invalidArgument("the mask is not gray or not of the view's size")
    }
    for index in patches.indices where mask.pixels[index] < least { patches[index] = .none }
  }

  /// Calls `body` with all patches in memory layout and native byte order, valid only during the
  /// call.
  package borrowing func withPatchBytes<Result>(
    _ body: (UnsafeRawBufferPointer) throws -> Result
  ) rethrows -> Result {
    try body(UnsafeRawBufferPointer(patches))
  }
}

/// The patches of one view, and which of them the filter accepted. Immutable.
package final class PatchMap: Sendable {
  /// The view that the patches belong to.
  package let view: PatchView
  private let patches: FrozenArray<ck_patch>
  /// The result of the filter; nil for an unfiltered map.
  package let states: PatchStates?

  fileprivate init(
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
