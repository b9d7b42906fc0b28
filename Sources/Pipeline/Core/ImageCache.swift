import Foundation
import SceneModel

/// Keeps images within a byte budget. Thread-safe.
///
/// New images displace only those of earlier stages, least recently used first: a stage reads all
/// photos in turn, often several times, and in such a scan the image that is needed again soonest
/// is the one that was used least recently.
final class ImageCache: Sendable {
  enum Content: Hashable {
    /// As decoded, with the sides divided by the reduction.
    case decoded(reduction: Int)
    /// Made from the photo as decoded with the reduction.
    case resized(width: Int, height: Int, reduction: Int)
    /// From one of the sets of masks of stores that share decoded images.
    case mask(width: Int, height: Int, set: UUID)
  }

  private struct Key: Hashable {
    var photo: ID<Photo>
    var content: Content
  }

  private struct State {
    var images: [Key: (image: RasterImage, lastUse: Int)] = [:]
    var byteCount = 0
    var clock = 0
    /// Images that were used before this time may be displaced.
    var stageStart = 0
  }

  private let byteBudget: Int
  private let state = Locked(State())

  init(byteBudget: Int) { self.byteBudget = byteBudget }

  func image(_ content: Content, of photo: ID<Photo>) -> RasterImage? {
    let key = Key(photo: photo, content: content)
    return state.withLock { state in
      guard let entry = state.images[key] else { return nil }
      state.clock += 1
      state.images[key]?.lastUse = state.clock
      return entry.image
    }
  }

  /// Allows images that are not used from now on to be displaced.
  func startStage() {
    state.withLock { $0.stageStart = $0.clock + 1 }
  }

  /// Adds an image if it fits into the budget, at the expense of images of earlier stages.
  func keep(_ image: RasterImage, _ content: Content, of photo: ID<Photo>) {
    let size = image.pixels.count
    let key = Key(photo: photo, content: content)
    guard size <= byteBudget else { return }
    state.withLock { state in
      guard state.images[key] == nil else { return }
      while state.byteCount + size > byteBudget {
        guard let oldest = state.images.min(by: { $0.value.lastUse < $1.value.lastUse }),
          oldest.value.lastUse < state.stageStart
        else { return }
        state.byteCount -= oldest.value.image.pixels.count
        state.images[oldest.key] = nil
      }
      state.clock += 1
      state.images[key] = (image, state.clock)
      state.byteCount += size
    }
  }
}
