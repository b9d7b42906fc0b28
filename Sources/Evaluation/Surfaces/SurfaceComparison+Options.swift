extension SurfaceComparison {
  package struct Options: Codable, Hashable, Sendable {
    /// Distance thresholds of precision, recall and F-score, in units of the reference. Chosen.
    package var thresholds = [0.0005, 0.001, 0.002]
    /// Distances are truncated at this value, in units of the reference. Chosen.
    package var maximumDistance = 0.02
    /// Number of samples on the result. Chosen.
    package var resultSamples = 1_000_000
    /// Number of samples on the reference. Chosen.
    package var referenceSamples = 200_000
    /// Parts of the result farther than this outside the reference's bounding box are ignored, in
    /// units of the reference: the table that an object stands on is not an error. Chosen.
    package var margin = 0.01
    /// Parts of the result and of the reference below this are ignored: the contact area of a
    /// supported object is not visible.
    package var floor: Floor?
    /// Parts of the reference visible to fewer cameras are ignored. Chosen.
    package var minimumViews = 3
    /// Maximum angle in degrees between the surface's normal and the direction to a camera that
    /// sees it. Limit: 90. PMVS reconstructs within 60 (Furukawa and Ponce, PAMI 2010).
    package var maximumViewAngleDegrees = 90.0
    /// Side of the voxels in which points of a cloud are averaged. Chosen: half a millimeter.
    package var voxel = 0.0005
    /// Number of threads; results are independent of it. Chosen.
    package var threadCount = 1

    package init() {}

    /// Compares at other thresholds: lengths above 0, in units of the reference.
    ///
    /// Distances are truncated at four times the largest one, and the margin is twice as wide as
    /// it, unless they are larger already (chosen): thresholds beyond the truncation would count
    /// every point.
    package mutating func compare(at thresholds: [Double]) {
      self.thresholds = thresholds.sorted()
      let largest = self.thresholds.last ?? 0
      maximumDistance = max(maximumDistance, 4 * largest)
      margin = max(margin, 2 * largest)
    }
  }
}
