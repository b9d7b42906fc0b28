extension ObjectIsolation {
  struct Options: Hashable, Codable, Sendable {
    /// Side of a sample's voxel in median footprints. Chosen.
    var sampleFootprints = 2.0
    /// Samples within this many sample sides of each other are connected. Chosen.
    var connectionSamples = 2.0
    /// Share of the photos that must have a sample in their frame for it to enter plane detection.
    /// Measured: tuned on the sets marked so in Benchmarks/sets.json.
    var focusCoverage = 0.4
    /// Share of the photos that must have a sample in their frame for it to belong to the object.
    /// Measured: as above.
    var objectCoverage = 0.15
    /// Samples farther from the focus than this share of the camera distance are not the object.
    /// Measured: as above.
    var reach = 0.9
    /// Components within this distance of the object, as a share of its size, belong to it.
    /// Measured: as above.
    var attachmentDistance = 0.04
    /// A component with at least this share of the main component's weight belongs to the object.
    /// Measured: as above.
    var secondaryShare = 0.25
    /// Minimum share of the object in the samples at the center of the view. Chosen.
    var minimumShare = 0.02
    var support = SupportPlaneDetection.Options()
    /// Minimum number of samples in the region that most photos cover. Chosen.
    var minimumRegionSamples = 30
    /// Samples closer to the focus than this share of the camera distance are at the center of the
    /// view. Chosen.
    var centralDistance: Float = 0.5
    /// Distance of a sample from the focus, in camera distances, at which its Gaussian weight is
    /// 1/e. Chosen.
    var weightDistance = 0.35
    /// Components with fewer samples are noise, however near. Chosen.
    var minimumComponentSamples = 8
    /// Share of the samples below the lowest part of an object, and above the highest of its base.
    /// Chosen.
    var baseQuantile = 0.02
    /// Maximum number of rounds in which components are attached to the object. Chosen.
    var attachmentRounds = 4
    /// Minimum of the attachment distance, in units of the distance of connected samples. Chosen.
    var minimumAttachment = 3.0
    /// Samples beyond the region within this many sample sides of the object continue it. Chosen.
    var contactSamples = 1.5
    /// If more than this share of the outline is truncated at the region's border, no object is
    /// clear. Chosen.
    var maximumTruncation = 0.25
    /// Whether the points are of a moving object and what carries it only, without anything that
    /// stands still.
    var showsOnlyObject = false
    /// Whether the points are of what stands in front of a plain backdrop, which may hide the
    /// support.
    var isForeground = false
    /// If at least this share of the samples are connected and end within the region, they are an
    /// object without surroundings. Chosen.
    var minimumBoundedShare = 0.9
    /// Share of the points that are outliers at each side of the bounds: of an object in the dense
    /// cloud, and of a scene or a sparse cloud. Chosen.
    var trimmedObjectShare = 0.0005
    var trimmedSceneShare = 0.01
    /// With at most this number of points, none is an outlier. Chosen.
    var minimumTrimmedPoints = 50

    init() {}
  }
}
