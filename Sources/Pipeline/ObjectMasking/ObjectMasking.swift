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
    /// The coarse reconstruction; only its steps at half resolution are used.
    var coarse = PointCloudGeneration.Options(maximumPixelsPerView: 160_000)
    var backdrop = BackdropDetection.Options()
    var isolation = ObjectIsolation.Options()
    /// Maximum number of pixels of a mask.
    var maximumPixels = 300_000
    /// Radius of the discs that points are drawn as, in footprints.
    var discRadius: Float = 0.75
    /// Distance from the outline of a region of points within which the region is inaccurate, in
    /// pixels of the coarse reconstruction: half the width of its patches.
    var rim = 2.5
    /// Distance from the object's points up to which its mask extends, as a share of the diagonal
    /// of their bounding box in the photo.
    var reach = 0.12
    var estimation = MaskEstimation.Options()
    /// Masks that agree less with the visual hull of all masks are not used.
    var minimumAgreement = 0.7
    /// If fewer masks than this share of the photos are usable, none is used.
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
    /// The coarse points that do not belong to the object.
    var surroundings = PointCloud()

    /// No masks.
    init(photoCount: Int) {
      masks = Array(repeating: nil, count: photoCount)
      agreement = Array(repeating: nil, count: photoCount)
    }

    /// These masks, with those of `other` where these are missing or overlap too little with them.
    func corrected(by other: Result?, minimumOverlap: Double) -> Result {
      guard let other else { return self }
      var result = self
      for (index, mask) in other.masks.enumerated() {
        guard let mask else { continue }
        let overlap = masks[index].map { $0.intersectionOverUnion(with: mask) } ?? 0
        guard overlap < minimumOverlap else { continue }
        (result.masks[index], result.agreement[index]) = (mask, other.agreement[index])
      }
      return result
    }

    /// Adds the masks of other photos.
    mutating func add(_ other: Result) {
      for index in masks.indices where other.masks[index] != nil {
        (masks[index], agreement[index]) = (other.masks[index], other.agreement[index])
      }
    }
  }

  var options = Options()

  /// Returns nil if the photos show no separate object. If `prior` is given, the object is what it
  /// retains, and its surroundings may have moved.
  func run(
    _ reconstruction: Reconstruction, images: ImageStore, prior: Silhouettes? = nil,
    _ context: StageContext
  ) throws -> Result? {
    let cloud: PointCloud
    do {
      cloud = try PointCloudGeneration(options: options.coarse)
        .coarseCloud(reconstruction, images: images, context.part(from: 0, to: 0.6))
    } catch is PipelineError {
      // The dense stage at full resolution reports why.
      return nil
    }
    let photos = try reducedPhotos(
      of: reconstruction, images, context.part(from: 0.6, to: 0.65).control)
    let isolationContext = context.part(from: 0.65, to: 0.7)
    let isolated =
      try prior.map {
        ObjectIsolation.Result(
          isKept: try $0.areInside(cloud.positions, isolationContext.control))
      } ?? isolate(cloud, photos, reconstruction, isolationContext)
    guard isolated.failure == nil else { return nil }
    let object = cloud.positions.indices.filter { isolated.isKept[$0] }
      .map { cloud.positions[$0] }
    let views = try views(
      of: photos, cloud, isolated.isKept, isRigid: prior == nil,
      context.part(from: 0.7, to: 0.75).control)
    let estimated = try MaskEstimation(options: options.estimation)
      .run(views, points: object, context.part(from: 0.75, to: 1))
    var result = Result(photoCount: reconstruction.photos.count)
    result.support = isolated.support
    result.surroundings = cloud.filtered(by: isolated.isKept.map { !$0 })
    return add(estimated, of: views, to: &result, context.notes) ? result : nil
  }

  /// The registered photos at the size of their masks.
  private func reducedPhotos(
    of reconstruction: Reconstruction, _ images: ImageStore, _ control: KernelControl
  ) throws -> [ReducedPhoto] {
    let photos = reconstruction.registered
    let reduced = try control.parallelMap(photos.count) {
      try ReducedPhoto(
        photos[$0], reconstruction, images.image(photos[$0], maximumPixels: options.maximumPixels))
    }
    let backdrops = try BackdropDetection(options: options.backdrop)
      .run(reduced.map(\.image), control)
    return zip(reduced, backdrops ?? []).map { photo, backdrop in
      var photo = photo
      photo.backdrop = backdrop
      return photo
    } + (backdrops == nil ? reduced : [])
  }

  /// Divides the cloud into object and surroundings; points of the backdrop are surroundings.
  private func isolate(
    _ cloud: PointCloud, _ photos: [ReducedPhoto], _ reconstruction: Reconstruction,
    _ context: StageContext
  ) throws -> ObjectIsolation.Result {
    let isBackdrop = backdropPoints(cloud, photos, reconstruction.photos.count)
    context.notes.record("backdropPoints", Double(isBackdrop.count { $0 }))
    let foreground = cloud.filtered(by: isBackdrop.map { !$0 })
    guard foreground.count > 0 else {
      return ObjectIsolation.Result(
        isKept: isBackdrop.map { !$0 }, failure: "all of it has the color of the backdrop.")
    }
    var result = try ObjectIsolation(options: options.isolation)
      .run(foreground, reconstruction, context)
    var isKept = result.isKept.makeIterator()
    result.isKept = isBackdrop.map { $0 ? false : isKept.next() ?? false }
    return result
  }

  /// Whether most photos that see a point show the backdrop there.
  private func backdropPoints(
    _ cloud: PointCloud, _ photos: [ReducedPhoto], _ count: Int
  ) -> [Bool] {
    var byPhoto = [ReducedPhoto?](repeating: nil, count: count)
    for photo in photos { byPhoto[photo.id.index] = photo }
    return cloud.positions.indices.map { index in
      let seen = cloud.visiblePhotos(of: index).compactMap { byPhoto[Int($0)] }
      let marked = seen.count { $0.showsBackdrop(at: SIMD3<Double>(cloud.positions[index])) }
      return 2 * marked > seen.count
    }
  }

  /// The points of the cloud as discs, labeled by whether they belong to the object.
  private func discs(_ cloud: PointCloud, _ isObject: [Bool]) -> Discs {
    Discs(
      positions: cloud.positions, radii: cloud.footprints.map { options.discRadius * $0 },
      labels: isObject.map { $0 ? PointLabel.object : PointLabel.surroundings })
  }

  /// The photos with the points drawn into them. Unless the scene is rigid, points of the
  /// surroundings are drawn only into the photos that agree on them.
  private func views(
    of photos: [ReducedPhoto], _ cloud: PointCloud, _ isObject: [Bool], isRigid: Bool,
    _ control: KernelControl
  ) throws -> [MaskingView] {
    let coarsePixels = Double(options.coarse.maximumPixelsPerView) / 4
    let all = discs(cloud, isObject)
    return try control.parallelMap(photos.count) { index in
      let photo = photos[index]
      let scale = max(1, (Double(photo.pixelCount) / coarsePixels).squareRoot())
      var discs = all
      if !isRigid {
        let isShown = cloud.positions.indices.map {
          isObject[$0] || cloud.visiblePhotos(of: $0).contains(UInt16(photo.id.index))
        }
        discs = self.discs(
          cloud.filtered(by: isShown), zip(isObject, isShown).filter(\.1).map(\.0))
      }
      return try MaskingView(
        photo, discs, rim: Int((options.rim * scale).rounded()), reach: options.reach,
        KernelControl())
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
