import ArgumentParser
import SceneModel

/// Properties of the photos that help to align them.
package struct AlignmentArguments: ParsableArguments {
  @Option(
    name: [.customShort("o"), .long],
    help: "Use 'sequential' if consecutive photos, in the order of file names, overlap.")
  package var sampleOrdering = SampleOrdering.unordered

  @Option(
    name: [.customShort("f"), .long],
    help: "Use 'high' for objects with little texture; it takes longer.")
  package var featureSensitivity = FeatureSensitivity.normal

  package init() {}

  func configure(_ configuration: inout PhotogrammetrySession.Configuration) {
    configuration.sampleOrdering = sampleOrdering == .sequential ? .sequential : .unordered
    configuration.featureSensitivity = featureSensitivity == .high ? .high : .normal
  }
}

extension SampleOrdering: ExpressibleByArgument {}
extension FeatureSensitivity: ExpressibleByArgument {}
