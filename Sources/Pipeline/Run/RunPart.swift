/// A part of a run that a process of its own makes from the parts before it, for those after it.
///
/// All results are in the checkpoint directory. An ordinary run with the same directory finds them,
/// and makes what is missing: the result is the same.
package enum RunPart: Hashable, Sendable {
  /// What a block of the files shows, each file by itself.
  case inspections(Block)
  /// The list of usable photos.
  case photos
  /// The features of a block of the photos.
  case features(Block)
  /// Which pairs are considered.
  case candidates
  /// Which of a block of these are promising, and so to be matched.
  case pairs(Block)
  /// The matches of a block of the pairs.
  case matches(Block)
  /// Which pairs to match, too, after the promising ones.
  case morePairs
  /// The matches of a block of these.
  case moreMatches(Block)
  /// Cameras, poses, sparse points and estimated masks.
  case cameras
  /// A step of the dense stage for a block of the views.
  case views(DensePart, Block)
  /// What the surface of the whole scene and all its tiles are made from.
  case tileBase
  /// The surface of the whole scene.
  case surface
  /// A step of the work on tiles for a block of them.
  case tiles(TilePart, Block)
  /// The list of all tiles.
  case tileIndex
}
