import Kernels
import SceneModel

/// Aligns photos by what their masks leave; where that is too little, by the whole photos.
///
/// What a mask leaves out may move, so that it is ignored as a rule. But around an object with hardly
/// any texture that stands still its surroundings tell where the cameras were. They are believed only
/// where what is seen of the object agrees, which it doesn't where the object turned and the camera
/// stood.
struct MaskedAlignment {
  struct Options: Hashable, Codable, Sendable {
    /// Share of the photos that must get a pose by what the masks leave.
    var minimumShare = 0.6
    /// Observations inside its mask that make a photo agree with the object.
    var minimumObservations = 8
    /// Share of the photos with a pose that must agree.
    var minimumAgreement = 0.6

    init() {}
  }

  var options = Options()
  var alignment: ImageAlignment

  init(_ alignment: ImageAlignment) { self.alignment = alignment }

  /// `wholePhotos` is a store of the same photos that knows no masks.
  func run(
    _ ingested: IngestedPhotos, images: ImageStore, wholePhotos: () -> ImageStore,
    _ context: StageContext
  ) throws -> Reconstruction {
    func align(_ images: ImageStore, _ notes: StageNotes) throws -> Reconstruction {
      try alignment.run(
        photos: ingested.photos, cameras: ingested.cameras, images: images,
        StageContext(control: context.control, notes: notes))
    }
    guard images.hasMasks else { return try align(images, context.notes) }
    let notes = StageNotes()
    let masked = Result { try align(images, notes) }
    if case .failure(let error) = masked, !(error is PipelineError) { throw error }
    let count = (try? masked.get())?.registered.count ?? 0
    if Double(count) < options.minimumShare * Double(ingested.photos.count) {
      let wholeNotes = StageNotes()
      do {
        let whole = try align(wholePhotos(), wholeNotes)
        if whole.registered.count > count, try agrees(whole, images) {
          context.notes.add(wholeNotes)
          context.notes.warn(
            "What the masks leave is too little to align the photos by; what is around the object was "
              + "used as well. That needs an object that stands still.")
          return whole
        }
      } catch is PipelineError {
        // The whole photos tell no more.
      }
    }
    context.notes.add(notes)
    return try masked.get()
  }

  /// Whether most photos see points of the object where the reconstruction has them.
  private func agrees(_ reconstruction: Reconstruction, _ images: ImageStore) throws -> Bool {
    var pixels = [[SIMD2<Double>]](repeating: [], count: reconstruction.photos.count)
    for observation in reconstruction.points.flatMap(\.track) {
      pixels[observation.photo.index].append(observation.pixel)
    }
    let registered = reconstruction.registered
    let agreeing = try registered.count { id in
      guard let mask = try images.mask(id) else { return true }
      let photo = reconstruction.photos[id.index]
      let factor =
        SIMD2(Double(mask.width), Double(mask.height))
        / SIMD2(Double(photo.width), Double(photo.height))
      let inside = pixels[id.index].count { mask.isMarked(at: $0 * factor) }
      return inside >= options.minimumObservations
    }
    return Double(agreeing) >= options.minimumAgreement * Double(registered.count)
  }
}
