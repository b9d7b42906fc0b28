import SceneModel

/// Feature tracks: features of several photos that are assumed to show the same point, as parallel
/// arrays.
///
/// The observations of track i are `observations(of: i)`, sorted by photo, at most one per photo.
package struct FeatureTracks: Sendable {
  /// Track i covers the observations `offsets[i]..<offsets[i + 1]`.
  package private(set) var offsets: [Int32] = [0]
  /// The photo of each observation.
  package private(set) var photos: [Int32] = []
  /// The feature of each observation, an index into the photo's `FeatureSet`.
  package private(set) var features: [Int32] = []
  /// The position of each observation in pixels of the upright photo, origin at the top-left
  /// corner.
  package private(set) var pixels: [SIMD2<Double>] = []
  /// The track of each observation.
  package private(set) var trackOfObservation: [Int32] = []
  /// The observations of each photo, in ascending order.
  package private(set) var observationsOfPhoto: [[Int32]]

  package init(photoCount: Int) {
    observationsOfPhoto = Array(repeating: [], count: photoCount)
  }

  /// The number of tracks.
  package var count: Int { offsets.count - 1 }

  /// The indices of the track's observations.
  package func observations(of track: Int) -> Range<Int> {
    Int(offsets[track])..<Int(offsets[track + 1])
  }

  /// Moves an observation within its photo.
  mutating func movePixel(of observation: Int, to pixel: SIMD2<Double>) {
    pixels[observation] = pixel
  }

  /// Appends a track; `members` are sorted by photo.
  package mutating func append(
    _ members: some Sequence<(photo: Int32, feature: Int32, pixel: SIMD2<Double>)>
  ) {
    let track = Int32(count)
    for member in members {
      observationsOfPhoto[Int(member.photo)].append(Int32(photos.count))
      photos.append(member.photo)
      features.append(member.feature)
      pixels.append(member.pixel)
      trackOfObservation.append(track)
    }
    offsets.append(Int32(photos.count))
  }
}
