import Foundation
import Kernels
import SceneModel

/// Estimates the masks of the object that the photos are aimed at, without being given any.
///
/// A coarse point cloud is divided into object and surroundings, drawn into the photos, and
/// completed to masks by colors, edges and the agreement of all photos.
struct ObjectMasking {
  /// Parameters of object masking.
  struct Options: Hashable, Codable, Sendable {
    /// Whether to mask the object if the photos have no masks.
    var isEnabled = true
    /// The coarse reconstruction; only its steps at half resolution are used. Chosen.
    var coarse = PointCloudGeneration.Options(maximumPixelsPerView: 160_000)
    var backdrop = BackdropDetection.Options()
    var shadows = ShadowPlane.Options()
    var isolation = ObjectIsolation.Options()
    /// Maximum number of pixels of a mask. Chosen.
    var maximumPixels = 300_000
    /// Radius of the discs that points are drawn as, in footprints. Chosen.
    var discRadius: Float = 0.75
    /// Coarse points of two placements of an object are of the same surface if they are within this
    /// many footprints of each other. Chosen.
    var neighborFootprints: Float = 1
    /// Radius of the discs that features of the surroundings are drawn as, in their scales, and its
    /// maximum in pixels. Chosen.
    var featureRadius: Float = 1.5
    var maximumFeatureRadius: Float = 4
    /// Distance from the outline of a region of points within which the region is inaccurate, in
    /// pixels of the coarse reconstruction. Limit: half the width of its patches.
    var rim = 2.5
    /// Distance from the object's points up to which its mask extends, as a share of the diagonal
    /// of their bounding box in the photo. Chosen.
    var reach = 0.12
    var estimation = MaskEstimation.Options()
    /// Masks that agree less with the visual hull of all masks are not used. Chosen.
    var minimumAgreement = 0.7
    /// If fewer masks than this share of the photos are usable, none is used. Chosen.
    var minimumShare = 0.6

    init() {}
  }

  /// The masks of the object, and what it stands on.
  struct Result: Sendable {
    /// Gray masks of the upright photos at reduced size, by photo ID; nil where none is usable.
    var masks: [RasterImage?]
    /// Agreement of each mask with those of all photos, 0…1, by photo ID; nil without a mask.
    var agreement: [Double?]
    var support: SupportPlane?
    /// What the masks are based on.
    var points = LabeledCloud(cloud: PointCloud(), isObject: [])

    /// No masks.
    init(photoCount: Int) {
      masks = Array(repeating: nil, count: photoCount)
      agreement = Array(repeating: nil, count: photoCount)
    }

    /// Adds the masks of photos that have none.
    mutating func complete(with other: Result) {
      for index in masks.indices where masks[index] == nil {
        (masks[index], agreement[index]) = (other.masks[index], other.agreement[index])
      }
    }
  }

  var options = Options()

  /// Returns nil if the photos show no separate object. If the prior says what the object is,
  /// its surroundings may have moved.
  func run(
    _ reconstruction: Reconstruction, images: ImageStore,
    prior: MaskPrior = MaskPrior(), _ context: StageContext
  ) throws -> Result? {
    guard let cloud = try coarseCloud(reconstruction, images, context.part(from: 0, to: 0.6)) else {
      return nil
    }
    let (photos, backdrop) = try context.notes.step("backdrop") {
      try reducedPhotos(of: reconstruction, images, context.part(from: 0.6, to: 0.65).control)
    }
    let isolationContext = context.part(from: 0.65, to: 0.7)
    var isolated: ObjectIsolation.Result?
    if prior.placements.isEmpty {
      isolated = try context.notes.step("isolation") {
        try isolate(cloud, photos, backdrop, reconstruction, isolationContext)
      }
      guard isolated?.failure == nil else { return nil }
    }
    let points =
      try isolated.map { LabeledCloud(cloud: cloud, isObject: $0.isKept) }
      ?? prior.object(
        in: cloud, tolerance: options.neighborFootprints, isolationContext.control)
    let views = try context.notes.step("drawing") {
      try self.views(
        of: photos, points, prior, reconstruction, context.part(from: 0.7, to: 0.75).control)
    }
    let estimated = try context.notes.step("maskEstimation") {
      try MaskEstimation(options: options.estimation)
        .run(views, points: points.object.positions, context.part(from: 0.75, to: 1))
    }
    var result = Result(photoCount: reconstruction.photos.count)
    result.support = isolated?.support
    result.points = points
    return add(estimated, of: views, to: &result, context.notes) ? result : nil
  }

  /// The coarse cloud; nil if the photos show no surface. The dense stage at full resolution
  /// reports why.
  func coarseCloud(
    _ reconstruction: Reconstruction, _ images: ImageStore, _ context: StageContext
  ) throws -> PointCloud? {
    do {
      return try context.notes.step("coarseCloud") {
        try PointCloudGeneration(options: options.coarse)
          .coarseCloud(reconstruction, images: images, context)
      }
    } catch is PipelineError {
      return nil
    }
  }

  /// The registered photos at the size of their masks, and the color of their backdrop.
  private func reducedPhotos(
    of reconstruction: Reconstruction, _ images: ImageStore, _ control: KernelControl
  ) throws -> ([ReducedPhoto], backdrop: SIMD3<Float>?) {
    let photos = reconstruction.registered
    var reduced = try control.parallelMap(photos.count) {
      try ReducedPhoto(
        photos[$0], reconstruction, images.image(photos[$0], maximumPixels: options.maximumPixels))
    }
    let backdrop = try BackdropDetection(options: options.backdrop)
      .run(reduced.map(\.image), control)
    guard let backdrop else { return (reduced, nil) }
    for (index, mask) in backdrop.masks.enumerated() { reduced[index].backdrop = mask }
    return (reduced, backdrop.color)
  }

  /// Divides the cloud into object and surroundings; points of the backdrop are surroundings.
  private func isolate(
    _ cloud: PointCloud, _ photos: [ReducedPhoto], _ backdrop: SIMD3<Float>?,
    _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> ObjectIsolation.Result {
    let shown = BackdropPoints(cloud, photos, photoCount: reconstruction.photos.count)
    let shadows = backdrop.flatMap {
      ShadowPlane(options: options.shadows)
        .run(cloud, colors: shown.colors, backdrop: $0, reconstruction)
    }
    let isBackdrop = cloud.positions.indices.map {
      shown.isBackdrop[$0] || shadows?.isShadow[$0] == true
    }
    context.notes.record("backdropPoints", Double(isBackdrop.count { $0 }))
    let foreground = cloud.filtered(by: isBackdrop.map { !$0 })
    guard foreground.count > 0 else {
      return ObjectIsolation.Result(
        isKept: isBackdrop.map { !$0 }, failure: "all of it has the color of the backdrop.")
    }
    var isolation = ObjectIsolation(options: options.isolation)
    isolation.options.isForeground = backdrop != nil
    var result = try isolation.run(foreground, reconstruction, context)
    result.support = result.support ?? shadows?.plane
    var isKept = result.isKept.makeIterator()
    result.isKept = isBackdrop.map { $0 ? false : isKept.next() ?? false }
    return result
  }

  /// The photos with the points drawn into them.
  private func views(
    of photos: [ReducedPhoto], _ points: LabeledCloud, _ prior: MaskPrior,
    _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws -> [MaskingView] {
    let coarsePixels = Double(options.coarse.maximumPixelsPerView) / 4
    let all = points.isRigid ? points.discs(radius: options.discRadius) : nil
    return try control.parallelMap(photos.count) { index in
      let photo = photos[index]
      let scale = max(1, (Double(photo.pixelCount) / coarsePixels).squareRoot())
      var labels = try (all ?? points.discs(in: photo.id, radius: options.discRadius))
        .drawn(by: photo.camera, at: photo.cameraFromWorld, KernelControl())
      let full = reconstruction.photos[photo.id.index]
      prior.drawFeatures(
        of: photo.id, full: SIMD2(Float(full.width), Float(full.height)),
        radius: options.featureRadius, maximumRadius: options.maximumFeatureRadius, into: &labels)
      return try MaskingView(
        photo, labels, rim: Int((options.rim * scale).rounded()), reach: options.reach)
    }
  }

  /// Adds the usable masks; returns false if they are too few.
  private func add(
    _ estimated: MaskEstimation.Result, of views: [MaskingView], to result: inout Result,
    _ notes: StageNotes
  ) -> Bool {
    for (index, view) in views.enumerated() {
      let (mask, agreement) = (estimated.masks[index], estimated.agreement[index])
      guard agreement >= options.minimumAgreement, mask.pixels.contains(where: { $0 != 0 }) else {
        continue
      }
      result.masks[view.photo.id.index] = mask
      result.agreement[view.photo.id.index] = agreement
    }
    let used = result.agreement.compactMap { $0 }
    notes.record("masks", Double(used.count))
    notes.record("maskAgreement", used.reduce(0, +) / Double(max(1, used.count)))
    return Double(used.count) >= options.minimumShare * Double(views.count)
  }
}
