import Foundation
import Kernels
import SceneModel

/// Finds places to take photos from that would show the parts of a surface which too few photos
/// show: greedy choice among views all around (next best view planning; Scott, Roth and Rivest,
/// "View planning for automated three-dimensional object reconstruction", ACM CSUR 2003).
struct MissingViews {
  struct Options {
    /// A part of the surface needs this many photos: with two, nothing confirms a match. Limit:
    /// three photos are the fewest that confirm each other.
    var sufficientPhotos = 3
    /// Parts that are smaller, as a share of the area, are not worth a photo. Measured: with 6
    /// complete rendered sets (dense5, orbit, `captures`) the best place gains 1.3 % at most, with
    /// 8 sets from which an arc or the top was left out 2.7 % or more.
    var minimumShare = 0.02
    /// The smallest cosine at which a photo shows a surface well: that of 65°. Matching fails
    /// beyond 30° from one photo to the next (Moreels and Perona, "Evaluation of features detectors
    /// and descriptors based on 3D objects", IJCV 2007). Chosen: 65°.
    var minimumCosine: Float = 0.42
    /// Number of places that are tried: one for every 8°. Chosen.
    var candidates = 600
    /// Number of samples of the surface. Chosen: a share is then exact to 1 %.
    var samples = 3000
    /// Maximum number of places. Chosen.
    var maximumPlaces = 24
  }

  var options = Options()

  /// A place, and the weak samples that it shows.
  struct Place: Hashable {
    var position: SIMD3<Double>
    var bearing: Compass.Bearing
    fileprivate var shown: [Int]
  }

  struct Result {
    /// The share of the area that too few photos show.
    var weakShare: Double
    /// The part of it that no place shows which can be reached.
    var unreachableShare: Double
    /// The best place first.
    var places: [Place]
    fileprivate var sampleShare: Double

    /// The share of the area that some of the places would show and too few photos do.
    func share(_ places: [Place]) -> Double {
      Double(Set(places.flatMap(\.shown)).count) * sampleShare
    }
  }

  /// `distance` is that of the places from the center of `compass`; below `lowestElevation`, in
  /// degrees, no photo can be taken.
  func run(
    _ evidence: ModelEvidence, _ compass: Compass, distance: Double, lowestElevation: Double,
    _ control: KernelControl
  ) throws -> Result {
    let samples = weakSamples(evidence)
    let bearings = Self.evenDirections(options.candidates)
      .filter { $0.elevation >= lowestElevation }
    let places = try control.parallelMap(bearings.count) { index in
      let position = compass.point(at: bearings[index], distance: distance)
      return Place(
        position: position, bearing: bearings[index],
        shown: try samples.shown(
          from: SIMD3<Float>(position), evidence.scene, minimumCosine: options.minimumCosine))
    }
    let reachable = Set(places.flatMap(\.shown)).count
    return Result(
      weakShare: samples.share,
      unreachableShare: samples.share - Double(reachable) * samples.area,
      places: chosen(places, samples), sampleShare: samples.area)
  }

  /// Chooses the places that show most of what needs photos, one after the other.
  private func chosen(_ places: [Place], _ samples: WeakSamples) -> [Place] {
    var needs = samples.needs
    var remaining = places
    var result: [Place] = []
    while result.count < options.maximumPlaces {
      let gains = remaining.map { place in
        Double(place.shown.count { needs[$0] > 0 }) * samples.area
      }
      guard let best = gains.indices.max(by: { gains[$0] < gains[$1] }),
        gains[best] >= options.minimumShare
      else { break }
      let place = remaining.remove(at: best)
      for sample in place.shown { needs[sample] -= 1 }
      result.append(place)
    }
    return result
  }

  /// Samples of equal area of what fewer than the sufficient number of photos show.
  private func weakSamples(_ evidence: ModelEvidence) -> WeakSamples {
    let areas = evidence.mesh.triangleAreas().map(Double.init)
    let total = max(areas.reduce(0, +), .leastNormalMagnitude)
    let step = 1 / Double(options.samples)
    var result = WeakSamples(area: step)
    var next = step / 2
    var sum = 0.0
    for (index, face) in evidence.faces.enumerated() {
      sum += areas[index] / total
      while next < sum {
        next += step
        let need = options.sufficientPhotos - Int(face.photoCount)
        if need > 0 { result.append(evidence.mesh, face: index, need: need) }
      }
    }
    return result
  }

  /// Evenly distributed directions (Fibonacci lattice; González, "Measurement of areas on a sphere
  /// using Fibonacci and latitude–longitude lattices", Math. Geosci. 2010).
  static func evenDirections(_ count: Int) -> [Compass.Bearing] {
    let golden = 360 / ((1 + 5.0.squareRoot()) / 2)
    return (0..<count).map { index in
      Compass.Bearing(
        azimuth: (Double(index) * golden).truncatingRemainder(dividingBy: 360),
        elevation: asin(1 - (2 * Double(index) + 1) / Double(count)) * 180 / .pi)
    }
  }
}

/// Points of a surface that too few photos show, of equal area.
private struct WeakSamples {
  /// Of one sample, as a share of the surface.
  var area: Double
  var positions: [SIMD3<Float>] = []
  var normals: [SIMD3<Float>] = []
  /// Number of photos that are missing.
  var needs: [Int] = []

  init(area: Double) { self.area = area }

  var share: Double { Double(needs.count) * area }

  mutating func append(_ mesh: Mesh, face: Int, need: Int) {
    let triangle = mesh.triangles[face]
    positions.append(mesh.center(of: triangle))
    normals.append(mesh.scaledNormal(of: triangle).normalized)
    needs.append(need)
  }

  /// The samples that a photo at `position` would show.
  func shown(
    from position: SIMD3<Float>, _ scene: RayScene, minimumCosine: Float
  ) throws -> [Int] {
    let facing = positions.indices.filter {
      normals[$0].dot((position - positions[$0]).normalized) >= minimumCosine
    }
    let blocked = try scene.isBlocked(
      from: facing.map { positions[$0] },
      to: [SIMD3<Float>](repeating: position, count: facing.count), KernelControl())
    return zip(facing, blocked).filter { !$0.1 }.map(\.0)
  }
}
