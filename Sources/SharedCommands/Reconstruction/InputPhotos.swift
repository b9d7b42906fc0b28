import Foundation

/// A folder of photos that a run reads.
package struct InputPhotos {
  package let url: URL
  /// Removes the folder when it is deallocated, if it is temporary.
  private let owner: AnyObject?

  package init(_ url: URL, owner: AnyObject? = nil) {
    self.url = url
    self.owner = owner
  }
}
