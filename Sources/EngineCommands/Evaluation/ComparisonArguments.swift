import ArgumentParser
import Evaluation
import SharedCommands

/// How surfaces and points are compared.
struct ComparisonArguments: ParsableArguments {
  @Option(
    name: .long, parsing: .upToNextOption,
    help: ArgumentHelp(
      "Distance thresholds of precision, recall and F-score. (default: 0.0005 0.001 0.002)",
      valueName: "length"))
  var threshold: [Double] = []

  @Option(
    name: .long,
    help: ArgumentHelp("Number of samples on the result's surface.", valueName: "count"))
  var samples = SurfaceComparison.Options().resultSamples

  @Option(
    name: .long,
    help: ArgumentHelp("Voxel size of the downsampling; 0 for none.", valueName: "length"))
  var voxel = SurfaceComparison.Options().voxel

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Ignore everything below this height, such as a table and what touches it.",
      valueName: "axis=height"))
  var floor: Floor?

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Recall counts the surface that this many cameras of the reference see.",
      valueName: "count"))
  var views = SurfaceComparison.Options().minimumViews

  @Option(
    name: .long,
    help: ArgumentHelp(
      "Largest angle to the surface's normal at which a camera counts as seeing it.",
      valueName: "degrees"))
  var viewAngle = SurfaceComparison.Options().maximumViewAngleDegrees

  @Option(
    name: .long,
    help: ArgumentHelp("Maximum width at which outlines are compared.", valueName: "pixels"))
  var outlineWidth = OutlineComparison.Options().maximumWidth

  func validate() throws {
    if threshold.contains(where: { !($0 > 0) || !$0.isFinite }) {
      throw ValidationError("Each --threshold must be a length above 0.")
    }
    if !(1...100_000_000).contains(samples) {
      throw ValidationError("--samples must be from 1 to 100000000.")
    }
    if !(voxel >= 0) || !voxel.isFinite {
      throw ValidationError("--voxel must be a length, or 0 for no downsampling.")
    }
    if !(1...1000).contains(views) {
      throw ValidationError("--views must be from 1 to 1000.")
    }
    if !(viewAngle > 0 && viewAngle <= 90) {
      throw ValidationError("--view-angle must be above 0 and at most 90.")
    }
    if !(16...10_000).contains(outlineWidth) {
      throw ValidationError("--outline-width must be from 16 to 10000.")
    }
  }

  func options(threadCount: Int) -> SurfaceComparison.Options {
    var options = SurfaceComparison.Options()
    if !threshold.isEmpty { options.compare(at: threshold) }
    options.resultSamples = samples
    options.floor = floor
    options.minimumViews = views
    options.maximumViewAngleDegrees = viewAngle
    options.threadCount = threadCount
    return options
  }
}

extension Floor: ExpressibleByArgument {
  /// Parses `z=0.004`.
  public init?(argument: String) {
    let parts = argument.split(separator: "=", maxSplits: 1, omittingEmptySubsequences: false)
    guard parts.count == 2, let axis = ["x", "y", "z"].firstIndex(of: parts[0].lowercased()),
      let height = Double(parts[1]), height.isFinite
    else { return nil }
    self.init(axis: axis, height: height)
  }
}
