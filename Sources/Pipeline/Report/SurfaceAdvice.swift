import Foundation
import Kernels
import SceneModel

/// Where to stand for the photos that are missing, as sentences.
struct SurfaceAdvice {
  private let compass: Compass
  private let ring: CameraRing
  private let missing: MissingViews.Result

  /// Photos closer than this, in degrees, match reliably; more would help little. Chosen: half the
  /// limit of SIFT, which is at about 30° (Moreels and Perona, 2007).
  private static let spacing = 15.0
  /// Elevation, in degrees, above which a place is "above" the object. Chosen.
  private static let steep = 60.0
  /// How far below the lowest photo, in degrees, another one can be taken: lower ones may be inside
  /// of what the object stands on. Chosen.
  private static let depth = 15.0
  /// The smallest share of the surface that is worth laying the object on another side for. Chosen.
  private static let minimumUnderside = 0.05

  /// Nil without registered photos.
  init?(
    _ evidence: ModelEvidence, _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws {
    let areas = evidence.mesh.triangleAreas()
    let total = max(areas.reduce(0, +), .leastNormalMagnitude)
    let sum = zip(evidence.mesh.triangles, areas).reduce(SIMD3<Float>.zero) {
      $0 + evidence.mesh.center(of: $1.0) * ($1.1 / total)
    }
    compass = Compass(center: SIMD3<Double>(sum), up: reconstruction.worldFrame.vertical)
    ring = CameraRing(reconstruction, compass)
    guard let distance = ring.distance, let lowest = ring.lowestElevation else { return nil }
    missing = try MissingViews().run(
      evidence, compass, distance: distance, lowestElevation: lowest - Self.depth, control)
  }

  /// The share of the surface that is on too few photos and that the advised places would show.
  var missingShare: Double { missing.share(missing.places) }

  /// The sentences: first what photos from reachable places would show, most of it first.
  var advice: [Advice] {
    let above = missing.places.filter { $0.bearing.elevation >= Self.steep }
    let sides = Dictionary(
      grouping: missing.places.filter { $0.bearing.elevation < Self.steep },
      by: { ring.gap(around: $0.bearing) })
    let reachable =
      sides.map { (missing.share($1), aside($1, $0)) }
      + (above.isEmpty ? [] : [(missing.share(above), fromAbove(above))])
    return reachable.sorted { ($1.0, $0.1.sentence) < ($0.0, $1.1.sentence) }.map(\.1)
      + (missing.unreachableShare < Self.minimumUnderside ? [] : [underneath])
  }

  private func advice(_ sentence: String, _ places: [MissingViews.Place]) -> Advice {
    Advice(
      kind: .surface, sentence: sentence,
      places: places.map { Advice.Place(position: $0.position, target: compass.center) })
  }

  private func percent(_ share: Double) -> String { "\(Int((share * 100).rounded())) %" }

  // MARK: - Sentences

  private var underneath: Advice {
    advice(
      "\(percent(missing.unreachableShare)) of the surface can't be seen from around the object: "
        + "its underside, or hollows. If you need it, lay the object on another side, photograph "
        + "it all around again, and put all photos into one folder: both series are joined.", [])
  }

  private func fromAbove(_ places: [MissingViews.Place]) -> Advice {
    advice(
      "The top is on too few photos (\(percent(missing.share(places))) of the surface). Raise the "
        + "camera: take a round of photos that look down at about 45°, then one or two from "
        + "straight above.", places)
  }

  /// On places between two photos beside each other.
  private func aside(_ places: [MissingViews.Place], _ gap: CameraRing.Gap?) -> Advice {
    let share = percent(missing.share(places))
    let elevation = places.reduce(0) { $0 + $1.bearing.elevation } / Double(places.count)
    guard let gap else {
      return advice(
        "One side is on too few photos (\(share) of the surface). Take more photos from there.",
        places)
    }
    let height = Self.height(elevation, comparedWith: gap.elevation)
    guard gap.width > 2 * Self.spacing else {
      return advice(
        "\(share) of the surface near \(gap.from) and \(gap.to) is on too few photos. Take about "
          + "\(places.count) more there, \(height).", places)
    }
    let count = max(places.count, Int((gap.width / Self.spacing).rounded(.up)) - 1)
    return advice(
      "The side between \(gap.from) and \(gap.to) is on too few photos (\(share) of the surface). "
        + "Walk from where you took the one to where you took the other, and take about \(count) "
        + "photos on the way, \(height).", places)
  }

  private static func height(_ elevation: Double, comparedWith other: Double) -> String {
    switch elevation - other {
    case ..<(-spacing): "lower than these"
    case ...spacing: "at the same height"
    default: "from higher up"
    }
  }
}
