// The module with `PhotogrammetrySession`, for all files of this one. On Linux, RealityKit would
// also load what programs for the Mac expect of Foundation.
#if os(Linux)
  @_exported import RealityFoundation
#else
  @_exported import RealityKit
#endif
