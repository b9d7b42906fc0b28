import SceneModel

/// Keeps the most recently used images within a byte budget. Thread-safe.
final class ImageCache: Sendable {
  enum Content: Hashable {
    /// As decoded, with the sides divided by the reduction.
    case decoded(reduction: Int)
    case resized(width: Int, height: Int)
    case mask(width: Int, height: Int)
  }

  private struct Key: Hashable {
    var photo: ID<Photo>
    var content: Content
  }

  private struct State {
    var images: [Key: (image: RasterImage, lastUse: Int)] = [:]
    var byteCount = 0
    var clock = 0
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

  /// Adds an image and drops the least recently used ones that exceed the budget.
  func keep(_ image: RasterImage, _ content: Content, of photo: ID<Photo>) {
    let size = image.pixels.count
    let key = Key(photo: photo, content: content)
    guard size <= byteBudget else { return }
    state.withLock { state in
      guard state.images[key] == nil else { return }
      while state.byteCount + size > byteBudget,
        let oldest = state.images.min(by: { $0.value.lastUse < $1.value.lastUse })
      {
        state.byteCount -= oldest.value.image.pixels.count
        state.images[oldest.key] = nil
      }
      state.clock += 1
      state.images[key] = (image, state.clock)
      state.byteCount += size
    }
  }
}
