import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct TriangulationTests {
  private func tracks(_ scene: SyntheticScene) -> (TrackObservations, PosedPhotos) {
    var tracks = TrackObservations()
    for (index, point) in scene.reconstruction.points.enumerated() {
      tracks.append(
        point.track.map {
          PointObservation(photo: $0.photo.rawValue, point: Int32(index), pixel: $0.pixel)
        })
    }
    let photos = PosedPhotos(
      cameras: [scene.camera], poses: scene.poses, cameraOfPhoto: scene.poses.map { _ in 0 })
    return (tracks, photos)
  }

  @Test(arguments: [0.0, 0.5, 1.0])
  func pointsAreTriangulated(pixels noise: Double) throws {
    var options = SyntheticScene.Options()
    options.pixelNoise = noise
    let scene = SyntheticScene(options)
    let (tracks, photos) = tracks(scene)
    let result = try Triangulation().run(tracks, photos: photos)
    var found = 0
    for (position, truth) in zip(result.positions, scene.reconstruction.points) {
      guard let position else { continue }
      found += 1
      #expect((position - truth.position).length < 1e-4 + 0.06 * noise)
    }
    #expect(Double(found) > 0.98 * Double(tracks.count))
  }

  @Test func outlierObservationsAreRejected() throws {
    let scene = SyntheticScene()
    var (tracks, photos) = tracks(scene)
    let long = (0..<tracks.count).filter { tracks.range($0).count >= 4 }
    for track in long { tracks.observations[tracks.range(track).lowerBound + 1].pixel += [60, 45] }
    let result = try Triangulation().run(tracks, photos: photos)
    for track in long {
      let range = tracks.range(track)
      guard let position = result.positions[track] else {
        Issue.record("track \(track) was lost")
        continue
      }
      #expect((position - scene.reconstruction.points[track].position).length < 1e-3)
      #expect(range.filter { !result.isInlier[$0] } == [range.lowerBound + 1])
    }
  }

  @Test func narrowAnglesAndPointsBehindAreRejected() throws {
    let camera = Camera(width: 1000, height: 1000, focalLength: [1000, 1000])
    let poses: [RigidTransform?] = [
      .identity, .init(rotation: .identity, translation: [-0.1, 0, 0]),
    ]
    let photos = PosedPhotos(cameras: [camera], poses: poses, cameraOfPhoto: [0, 0])
    var tracks = TrackObservations()
    for point: SIMD3<Double> in [[0, 0, 2], [0, 0, 100]] {
      tracks.append(
        (0..<2).map {
          PointObservation(
            photo: Int32($0), point: 0, pixel: camera.project((poses[$0] ?? .identity) * point))
        })
    }
    // Rays that intersect behind the cameras.
    tracks.append([
      PointObservation(photo: 0, point: 0, pixel: [400, 500]),
      PointObservation(photo: 1, point: 0, pixel: [600, 500]),
    ])
    tracks.append([PointObservation(photo: 0, point: 0, pixel: [400, 500])])
    let result = try Triangulation().run(tracks, photos: photos)
    #expect(result.positions.map { $0 != nil } == [true, false, false, false])
  }

  @Test func measuredErrorsMatchTheScene() throws {
    let scene = SyntheticScene()
    var (tracks, photos) = tracks(scene)
    tracks.observations[0].pixel += [3, 4]
    let positions = scene.reconstruction.points.map(\.position)
    let (errors, angles) = try Triangulation.measure(
      tracks, positions: positions, photos: photos, maximumError: 1)
    #expect(abs(errors[0] - 5) < 1e-3)
    #expect(errors.dropFirst().allSatisfy { $0 < 1e-3 })
    #expect(angles.dropFirst().allSatisfy { $0 > 0.2 })
  }
}
