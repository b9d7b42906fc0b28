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
