extension SceneAmbiguityCheck {
  package struct Options: Hashable, Codable, Sendable {
    /// Number of nearest photos that each photo is compared with. Chosen.
    package var neighbors = 4
    /// Their maximum distance relative to the median depth, and the maximum angle of the optical
    /// axes. Chosen.
    package var relativeDistance = 0.6
    package var axisDegrees = 45.0
    /// Points are compared if both photos observe them from directions up to this angle apart, in
    /// degrees, and at distances up to this ratio. Chosen.
    package var maximumAngleDegrees = 20.0
    package var maximumDistanceRatio = 1.4
    /// Maximum number of points of a photo that are searched for in another. Chosen.
    package var maximumPoints = 150
    /// A point that is farther away than its surroundings in the photo by more than this ratio may
    /// be occluded. Chosen.
    package var depthTolerance = 1.03
    /// Distance between template samples in σ of the feature, and its minimum as a fraction of the
    /// photo's longer side. Chosen: as in `ObservationRefinement`.
    package var stepPerScale = 1.0 / 3
    package var relativeStep = 1.0 / 1400
    /// Half the side of a template plus the search range, in template samples. Chosen.
    package var templateReach = 10.0
    /// Maximum displacement of a template from where its search starts, in template samples.
    /// Chosen.
    package var maximumShift = 4.0
    /// Photos with more pixels are reduced to this size. Chosen: as in `ObservationRefinement`.
    package var workingPixels = 6_500_000
    /// Correlation (ZNCC) from which on a point counts as present, and below which it counts as
    /// absent. Measured: on fourteen rendered scenes and seven real sets
    /// (docs/experiments/2026-11-alignment.md, Repeated structure).
    package var presentCorrelation = 0.75
    package var absentCorrelation = 0.5
    /// Cells along the longer side of a photo. A cell contradicts if it has at least `cellPoints`
    /// absent points and fewer than half as many present ones. Measured: as above.
    package var cells = 20
    package var cellPoints = 2
    /// Minimum number of cells that contradict, in both photos together, and of absent points, for
    /// a conflict. Measured: 3 cells at most in the 409 pairs of 10 real sets in which nothing was
    /// moved, 6 in one of 100 pairs of rendered wallpaper, and up to 8 where a small object was
    /// turned over (`captures 61`, axe).
    package var minimumCells = 6
    package var minimumPoints = 12
    /// Minimum number of pairs in conflict, and minimum share of the pairs that show at least
    /// `minimumPoints` of each other's points, present or absent. Measured: the share on captures
    /// of seed 61, where the axe laid on its other side was aligned by the table
    /// (docs/experiments/2026-11-moving-objects.md, Verdicts).
    package var minimumConflicts = 2
    package var minimumConflictShare = 0.1
    /// Maximum distance of a projected point from a match with it, as a fraction of the photo's
    /// longer side. Chosen.
    package var contradictionTolerance = 0.01
    /// Pairs with fewer matches that have a point are not evaluated. Chosen.
    package var minimumPairMatches = 30
    /// Fraction of agreeing matches below which a pair contradicts the reconstruction. Measured: on
    /// fourteen rendered scenes and seven real sets (docs/experiments/2026-11-alignment.md,
    /// Repeated structure).
    package var maximumAgreement = 0.2
    /// A pair contradicts the reconstruction if it has at least this share of the matches of the
    /// weakest pair in the strongest chain between its photos. Measured: 0.06 to 0.10 for six pairs
    /// of dtu_scan24 that confuse two rows of windows in a correct map; 0.24 to 1.34 in the folded
    /// maps of `SceneAmbiguityCheckTests`, and above 0.2 for 237 of the 283 pairs that contradict
    /// the first, folded maps of `wallpaper 2` and `3`.
    package var minimumContradictionStrength = 0.2
    /// Number of pairs whose matches contradict the reconstruction, and their share of all pairs,
    /// from which on it is questioned. Measured: of the 743 pairs of 50 rendered photos in front of
    /// a wallpaper that repeats, aligned exactly, eight are not recognized as repetition; 62 of 794
    /// contradict a map of them that is folded.
    package var minimumContradicted = 2
    package var minimumContradictedShare = 0.015
    /// How photos are divided if the object seems to have been moved.
    var placements = PlacementDetection.Options()

    package init() {}
  }
}
