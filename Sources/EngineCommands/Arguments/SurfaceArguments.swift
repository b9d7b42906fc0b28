import ArgumentParser

/// How the surface is made.
struct SurfaceArguments: ParsableArguments {
  @Flag(
    name: .long,
    help: """
      Leave holes where no photo shows the surface, such as the underside. By default an object is \
      closed.
      """)
  var keepGaps = false

  @Flag(
    name: .long,
    help: """
      Refine the surface against the photos at up to four times the resolution: crisper relief and \
      higher accuracy, but slower.
      """)
  var refine = false
}
