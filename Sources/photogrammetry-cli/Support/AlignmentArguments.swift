import ArgumentParser
import RealityKit

/// What is known of the photos before they are aligned.
struct AlignmentArguments: ParsableArguments {
  @Option(
    name: [.customShort("o"), .long],
    help: "Whether neighbors in the order of file names show the same part.")
  var sampleOrdering = OrderingArgument.unordered

  @Option(
    name: [.customShort("f"), .long],
    help: "Use 'high' for objects with little texture; it takes longer.")
  var featureSensitivity = SensitivityArgument.normal
}

/// The orders of photos of the command line.
enum OrderingArgument: String, ExpressibleByArgument, CaseIterable {
  case unordered, sequential

  var ordering: PhotogrammetrySession.Configuration.SampleOrdering {
    self == .sequential ? .sequential : .unordered
  }
}

/// The feature sensitivities of the command line.
enum SensitivityArgument: String, ExpressibleByArgument, CaseIterable {
  case normal, high

  var sensitivity: PhotogrammetrySession.Configuration.FeatureSensitivity {
    self == .high ? .high : .normal
  }
}
