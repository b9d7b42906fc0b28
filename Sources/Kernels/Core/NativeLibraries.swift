import CKernels

/// The C++ libraries that kernels are built on.
package enum NativeLibraries {
  /// Suppresses their messages and everything that C++ code writes to `std::cerr`, and limits
  /// OpenCV to one thread, for the whole process.
  ///
  /// To be called from the `main` of an executable: kernels themselves do not change settings of
  /// the process.
  package static func silence() { ck_silence_libraries() }
}
