extension ObservationRefinement {
  package struct Options: Hashable, Codable, Sendable {
    /// Photos with more pixels are reduced to this size. Chosen: as in `FeatureExtraction`.
    package var workingPixels = 6_500_000
    /// Distance between template samples in σ of the feature; at least one working pixel. Chosen.
    package var stepPerScale = 1.0 / 3
    /// Minimum correlation (ZNCC) of a known observation, and of a new one. Chosen.
    package var minimumCorrelation = 0.8
    package var minimumNewCorrelation = 0.9
    /// Maximum displacement in working pixels of a known observation, and of a new one from its
    /// expected position. Chosen.
    package var maximumShift = 3.0
    package var maximumNewShift = 1.0
    /// Standard deviation of observations in working pixels that has other causes than noise, such
    /// as the curvature of the surface. Measured: rendered sets prefer less, dtu_scan24 more
    /// (docs/experiments/2026-11-precision.md).
    package var positionFloor = 0.05
    /// A photo with a smaller fraction of confirmed observations keeps the unconfirmed ones
    /// unchanged. Chosen.
    package var minimumConfirmedShare = 0.25
    /// Minimum number of observations that keep a photo registered. Chosen.
    package var minimumObservations = 10
    /// The same for a blurred photo, as a share of the median photo's observations. Chosen.
    package var minimumShareIfBlurred = 0.05
    /// If a smaller fraction of the points remains, the refinement is discarded: the photos don't
    /// show what the poses predict. Chosen.
    package var minimumPointShare = 0.5
    /// Maximum number of photos that a point is searched for in: those that share the most points
    /// with its reference photo. Chosen.
    package var neighbors = 20
    /// Maximum angle in degrees between a new observation's ray and the mean of the known ones.
    /// Chosen.
    package var maximumAngleDegrees = 40.0
    /// Maximum reprojection error as a multiple of the median, and its bounds in working pixels.
    /// Chosen.
    package var errorFactor = 6.0
    package var errorBounds = 0.5...2.0
    /// Transition of the Huber loss from quadratic to linear, as a multiple of the median error.
    /// Chosen.
    package var huberFactor = 2.5
    /// Its minimum in working pixels. Chosen.
    package var minimumHuberWidth = 0.1
    var adjustment = MapAdjustment.Options()

    package init() {}

    /// The width of a working pixel, in pixels of the full-size photo.
    func workingPixel(width: Int, height: Int) -> Double {
      max(1, (Double(width * height) / Double(workingPixels)).squareRoot())
    }
  }
}
