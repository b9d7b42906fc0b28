import CKernels

/// The C++ libraries that kernels are built on.
package enum NativeLibraries {
  /// Suppresses their messages, and all that C++ code writes to `std::cerr`, for the whole process.
  ///
  /// For the `main` of an executable; kernels change no setting of the process that they run in.
  package static func silence() { ck_silence_libraries() }
}
