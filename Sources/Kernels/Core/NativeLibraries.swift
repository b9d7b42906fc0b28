import CKernels
import Foundation

/// The C++ libraries that kernels are built on.
package enum NativeLibraries {
  /// Suppresses their messages and everything that C++ code writes to `std::cerr`, and limits
  /// OpenCV to one thread, for the whole process.
  ///
  /// To be called from the `main` of an executable: kernels themselves do not change settings of
  /// the process.
  package static func silence() { ck_silence_libraries() }

  /// The name and version of each linked library, one per line.
  package static var versions: String { String(cString: ck_library_versions()) }

  /// The JavaScript library of the report's page, if the program was linked with it.
  package static var viewerBundle: Data? {
    let bundle = ck_viewer_bundle()
    return bundle.data.map { Data(bytes: $0, count: bundle.count) }
  }

  /// Returns memory that was freed to the system. The allocator keeps most of it for later
  /// allocations of a similar size, which adds to the peak memory if they are of another size.
  package static func releaseFreeMemory() { ck_release_free_memory() }
}
