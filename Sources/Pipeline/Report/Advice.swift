import SceneModel

/// A sentence on how to get a better model, with the places that it speaks of.
package struct Advice: Hashable, Codable, Sendable {
  package enum Kind: String, Codable, Sendable {
    /// Too few photos show a part of the surface.
    case surface
    /// Photos are missing between groups of photos.
    case bridge
    /// Photos are blurred, or differ in exposure.
    case blur, exposure
    /// The photos show too little detail, or there are too few.
    case texture, photos
  }

  /// A place to take a photo from, in the world frame.
  package struct Place: Hashable, Codable, Sendable {
    package var position: SIMD3<Double>
    /// What the camera is aimed at.
    package var target: SIMD3<Double>
  }

  package var kind: Kind
  package var sentence: String
  /// The names of the photos that the sentence is about.
  package var photos: [String] = []
  package var places: [Place] = []
}
