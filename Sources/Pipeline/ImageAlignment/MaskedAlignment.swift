import Kernels
import SceneModel

/// Aligns photos by the unmasked object; if that is too little, by the whole photos.
///
/// Masked-out areas may move and are therefore ignored by default. But if a static object has
/// hardly any texture, its surroundings determine the camera poses. The result from whole photos is
/// accepted only if the observations of the object are consistent with it, which they aren't if the
/// object was rotated in front of a static camera.
struct MaskedAlignment {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum fraction of the photos that must be registered by the masked object alone. Chosen.
    var minimumShare = 0.6
    /// Minimum number of observations inside its mask for a photo to agree with the object. Chosen.
    var minimumObservations = 8
    /// Minimum fraction of the registered photos that must agree. Chosen.
    var minimumAgreement = 0.6

    init() {}
  }

  var options = Options()
  var alignment: ImageAlignment

  init(_ alignment: ImageAlignment) { self.alignment = alignment }

  /// The alignment by the masked photos, or by the whole ones.
  func run(
    _ ingested: IngestedPhotos, images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    func align(
      _ images: ImageStore, by alignment: ImageAlignment, _ notes: StageNotes
    ) throws -> Reconstruction {
      try alignment.run(
        photos: ingested.photos, cameras: ingested.cameras, images: images,
        StageContext(control: context.control, notes: notes))
    }
    guard images.hasMasks else { return try align(images, by: alignment, context.notes) }
    let notes = StageNotes(meter: context.notes.meter)
    let masked = Result { try align(images, by: alignment, notes) }
    if case .failure(let error) = masked, !(error is PipelineError) { throw error }
    let count = (try? masked.get())?.registered.count ?? 0
    if Double(count) < options.minimumShare * Double(ingested.photos.count) {
      let wholeNotes = StageNotes(meter: context.notes.meter)
      // The object is checked below.
      var unchecked = alignment
      unchecked.options.focus = nil
      do {
        let whole = try align(
          ImageStore(withoutMasksOf: images), by: unchecked, wholeNotes)
        if whole.registered.count > count, try agrees(whole, images) {
          context.notes.add(wholeNotes)
          context.notes.warn(
            "The masked object alone is not enough to align the photos; its surroundings were used "
              + "as well. This requires a static object.")
          return whole
        }
      } catch is PipelineError {
        // The whole photos are no better.
      }
    }
    context.notes.add(notes)
    return try masked.get()
  }

  /// Whether most photos have observations inside their masks.
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
