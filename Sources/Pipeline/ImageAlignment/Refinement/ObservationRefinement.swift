import Kernels
import SceneModel

/// Refines observations to a few hundredths of a pixel by template matching, finds observations
/// that feature matching missed, and adjusts the reconstruction to them.
///
/// Independent detection in each photo has errors of about a third of a pixel. Here one photo of a
/// track provides a template, and least squares matching (Gruen, "Adaptive least squares
/// correlation", 1985) localizes it in the other photos through the warp predicted from the poses,
/// also in photos where the point should be visible but has no feature. Similar in spirit to
/// Lindenberger et al., "Pixel-perfect structure-from-motion", ICCV 2021.
package struct ObservationRefinement: Sendable {
  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the reconstruction adjusted to refined observations; `cameras` are those before any
  /// adjustment.
  package func run(
    _ reconstruction: Reconstruction, features: [FeatureSet], cameras: [Camera],
    images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    guard !reconstruction.points.isEmpty else { return reconstruction }
    var map = SparseMap(reconstruction)
    var adjustment = MapAdjustment(options: options.adjustment, initialCameras: cameras)
    let search = try TemplateSearch(
      map, features: features, photos: reconstruction.photos, images: images, options,
      context.part(from: 0, to: 0.2))
    try search.refine(&map, context.part(from: 0.2, to: 0.4))
    try adjustAndFilter(
      &map, reconstruction.photos, &adjustment, context.part(from: 0.4, to: 0.5))
    let found = try search.extend(&map, context.part(from: 0.5, to: 0.75))
    context.notes.record("newObservations", Double(found))
    try adjustAndFilter(
      &map, reconstruction.photos, &adjustment, context.part(from: 0.75, to: 0.85))
    try adjustment.simplifyCameras(&map, context.control.part(from: 0.85, to: 0.9))
    try adjustAndFilter(
      &map, reconstruction.photos, &adjustment, isFinal: true, context.part(from: 0.9, to: 1))
    var refined = try map.reconstruction(
      like: reconstruction, features: features, context.control)
    let losesTooManyPoints =
      Double(refined.points.count) < options.minimumPointShare * Double(reconstruction.points.count)
    guard !losesTooManyPoints else { return reconstruction }
    refined.unregistered += reconstruction.registered.map(\.index)
      .filter { !map.isRegistered($0) }.map { Self.rejection(of: reconstruction.photos[$0]) }
    return refined
  }

  private static func rejection(of photo: Photo) -> RejectedPhoto {
    RejectedPhoto(
      sampleID: photo.sampleID, name: photo.name, fault: .notRegistered,
      reason: "\(photo.name) shows hardly any point where its pose predicts it; it may be "
        + "blurred, or something moved.")
  }

  /// Runs a global adjustment and removes what then contradicts it: observations, and photos with
  /// too few remaining observations, whose poses would no longer be updated.
  private func adjustAndFilter(
    _ map: inout SparseMap, _ photos: [Photo], _ adjustment: inout MapAdjustment,
    isFinal: Bool = false, _ context: StageContext
  ) throws {
    let pixel =
      map.photos.cameras.map { options.workingPixel(width: $0.width, height: $0.height) }
      .max() ?? 1
    let median = try map.medianError(context.control)
    adjustment.options.huberWidth = max(
      options.huberFactor * median, options.minimumHuberWidth * pixel)
    try adjustment.adjustGlobally(&map, isFinal: isFinal, context.control)
    let bounds = options.errorBounds
    let error = min(
      max(
        options.errorFactor * (try map.medianError(context.control)) / pixel,
        bounds.lowerBound), bounds.upperBound)
    let points = PointTriangulation(options: .init(maximumError: error * pixel))
    try points.filter(Array(map.isTriangulated.indices), in: &map, context.control)
    for photo in weakPhotos(map, photos) { map.remove(photo) }
  }

  /// The photos with too few active observations. Those of a blurred photo are imprecise, and if
  /// most of them are rejected, the rest agrees by chance.
  private func weakPhotos(_ map: SparseMap, _ photos: [Photo]) -> [Int] {
    let counts = map.registered.map { map.activeCount(ofPhoto: $0) }
    let typical = options.minimumShareIfBlurred * Double(counts.upperMedian ?? 0)
    return zip(map.registered, counts).filter { photo, count in
      count < options.minimumObservations
        || photos[photo].sharpPixels != nil && Double(count) < typical
    }.map(\.0)
  }
}
