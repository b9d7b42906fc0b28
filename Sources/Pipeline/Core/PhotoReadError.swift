import Foundation
import ImageFiles

/// A photo that was readable when the run began and no longer is.
package struct PhotoReadError: LocalizedError, Sendable {
  /// The name of the photo or of its mask.
  package var name: String
  package var reason: ImageError

  package var errorDescription: String? {
    "\(name) can't be used: \(reason.errorDescription ?? "unknown reason")."
  }
}
