import CKernels

/// Observations grouped by track: those of track i are `observations[offsets[i]..<offsets[i + 1]]`.
package struct TrackObservations: Sendable {
  /// `count` + 1 ascending offsets.
  package var offsets: [Int32] = [0]
  package var observations: [PointObservation] = []

  package init() {}

  /// The tracks of each part after those of the parts before it.
  package init(joining parts: [TrackObservations]) {
    offsets.reserveCapacity(1 + parts.reduce(0) { $0 + $1.count })
    observations.reserveCapacity(parts.reduce(0) { $0 + $1.observations.count })
    for part in parts {
      let start = Int32(observations.count)
      offsets += part.offsets.dropFirst().lazy.map { $0 + start }
      observations += part.observations
    }
  }

  /// Number of tracks.
  package var count: Int { offsets.count - 1 }

  /// The observations of a track.
  package func range(_ track: Int) -> Range<Int> {
    Int(offsets[track])..<Int(offsets[track + 1])
  }

  /// Adds the observations of the next track.
  package mutating func append(_ track: some Sequence<PointObservation>) {
    observations.append(contentsOf: track)
    endTrack()
  }

  /// Adds an observation of the track that `endTrack()` ends.
  package mutating func append(_ observation: PointObservation) {
    observations.append(observation)
  }

  /// Ends a track; the next observations are those of another one.
  package mutating func endTrack() { offsets.append(Int32(observations.count)) }

  /// Calls `body` with the C representation, valid only during the call.
  func withKernelValue<Result>(
    _ body: (UnsafePointer<ck_tracks>) throws -> Result
  ) rethrows -> Result {
    let raw = KernelArray(observations.lazy.map(\.raw))
    return try withExtendedLifetime(raw) {
      try offsets.withUnsafeBufferPointer { offsets in
        var tracks = ck_tracks(
          offsets: offsets.baseAddress, count: count, observations: raw.base)
        return try body(&tracks)
      }
    }
  }
}
