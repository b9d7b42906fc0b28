import Kernels

/// What a surface is made from, whole or in tiles.
struct SurfaceSystem {
  let samples: SurfaceSamples
  /// The solved system, whose surface is that of the samples.
  let solution: PoissonSolution
}
