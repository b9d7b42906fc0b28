import SceneModel

/// The samples of a scene, from which another process makes its surface, and what is known of the
/// stages up to there.
struct SampleRecord: LargeUnitValue {
  var samples: SurfaceSamples
  var denseNotes: SavedNotes
  var notes: SavedNotes
}
