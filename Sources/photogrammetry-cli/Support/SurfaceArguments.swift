import ArgumentParser
import RealityKit

#if canImport(Pipeline)
  import RealityFoundation

  /// How the surface is made, as far as only our engine can be told.
  struct SurfaceArguments: ParsableArguments {
    @Flag(
      name: .long,
      help: """
        Leave open what no photo shows, the underside for instance: all of the surface is then \
        measured. Otherwise an object is closed.
        """)
    var keepGaps = false

    @Flag(
      name: .long,
      help: """
        Fit the surface to the photos at up to four times the pixels it was made from: crisper relief, \
        and nearer to the truth, for more time.
        """)
    var refine = false

    func configure(_ session: PhotogrammetrySession) {
      session.engineOptions.closesObject = !keepGaps
      session.engineOptions.refinesSurface = refine
    }
  }
#else
  /// Apple's engine has no such options.
  struct SurfaceArguments: ParsableArguments {
    func configure(_ session: PhotogrammetrySession) {}
  }
#endif
