import SceneModel

extension SceneAmbiguityCheck {
  /// What two photos with nearly the same pose show of each other's points: evidence for or against
  /// these poses. Points are indices into the points of the reconstruction.
  package struct Comparison: Hashable, Sendable {
    package var pair: PhotoPair
    /// Points that feature matching found in only one of the photos and whose texture both show.
    package var present: [Int32] = []
    /// Points that one photo shows and the other should show but doesn't.
    package var absent: [Int32] = []
    /// The absent points of the cells that contradict.
    package var contradicting: [Int32] = []
    /// Number of cells with absent points and fewer than half as many present ones.
    package var contradictingCells = 0
  }
}
