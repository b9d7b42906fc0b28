import Foundation

/// What a run is asked to make a model from.
package enum PhotoInput: Hashable, Sendable {
  /// A folder of photos.
  case folder(URL)
  /// A video, whose frames become photos.
  case video(URL)
}
