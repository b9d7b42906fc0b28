import SceneModel

extension SceneAmbiguityCheck {
  /// Evidence for or against two photos having nearly the same pose.
  package struct Evidence: Hashable, Sendable {
    package var pair: PhotoPair
    /// Points that feature matching found in only one of the photos and whose texture both show.
    package var present = 0
    /// Points that one photo shows and the other should show but doesn't.
    package var absent = 0
    /// Cells of the photos with absent points.
    package var contradictingCells = 0
  }
}
