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

    func configure(_ session: PhotogrammetrySession) {
      session.engineOptions.closesObject = !keepGaps
    }
  }
#else
  /// Apple's engine has no such options.
  struct SurfaceArguments: ParsableArguments {
    func configure(_ session: PhotogrammetrySession) {}
  }
#endif
