import ArgumentParser

/// What is up in the model, if the user knows better.
struct UpArguments: ParsableArguments {
  @Option(
    name: .long,
    help: ArgumentHelp(
      "What is up: the side of the photos that was up when they were taken (top, bottom, left, "
        + "right), or an axis of the model that results without this option (x, -x, y, -y, z, -z).",
      valueName: "direction"))
  var up: UpArgument?
}
