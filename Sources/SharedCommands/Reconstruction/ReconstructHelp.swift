/// The discussion in the help of `reconstruct`.
enum ReconstructHelp {
  /// All sections, including those of `engine`.
  static func discussion(_ engine: EngineHelp) -> String {
    [
      introduction, examples + engine.examples, DetailArguments.help, engine.outputs,
      engine.input, events + engine.events,
      "Paths of written files go to stdout, everything else to stderr.",
    ].filter { !$0.isEmpty }.joined(separator: "\n")
  }

  private static let introduction = """
    Take 20 to 200 sharp photos all around the object, each overlapping its neighbors by 70 % or \
    more. Keep the lighting even.

    """

  private static let examples = """
    EXAMPLES
      photogrammetry-cli photos/ model.usdz
          One file for AR Quick Look, at the 'reduced' level.
      photogrammetry-cli photos/ model.usdz -d medium --checkpoint-directory work/
          More detail; intermediate results are kept in work/.
      photogrammetry-cli photos/ model/ --poses poses.json --point-cloud points.ply
          A folder with OBJ, MTL, USDA and textures, plus camera poses and points.
      photogrammetry-cli facade/ facade.usdz --no-object-masking -o sequential
          A scene instead of an object, photographed from left to right.

    """

  private static let events = """
    EVENTS (with --json: one JSON object per line on stdout, and nothing else)
      progress             fraction, stage, remainingSeconds once it is known
      inputComplete        all photos were read
      invalidSample        sample, reason: a photo that is not used
      skippedSample        sample: a photo that could not be registered
      automaticDownsampling, stitchingIncomplete
      warning              message
      written              kind (model, preview, poses, pointCloud, report), path
    The last event is one of
      complete             seconds, photos, registered, triangles
      failed               message with the remedy, seconds, isTransient (whether
                           another attempt may succeed)
      cancelled            message, seconds

    """
}
