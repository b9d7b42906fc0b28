import Foundation
import Kernels
import SceneModel

/// A video of an object that someone films while walking around it.
///
/// The walker's speed and the height of the camera vary, and the hand trembles. A frame is exposed
/// row by row (rolling shutter), and for a part of the time between frames, so that motion blurs
/// it. The brightness drifts as that of an automatic exposure.
package struct WalkAroundVideo: Sendable {
  package var width = 1280
  package var height = 720
  package var seconds = 30.0
  package var framesPerSecond = 24.0
  /// Seconds that a pixel is exposed: indoor light.
  package var exposure = 1.0 / 60
  /// Seconds from the exposure of the first row to that of the last.
  package var readout = 1.0 / 60
  /// Rays per pixel, distributed over its area and its exposure.
  package var samples = 4

  private let scene: RenderedScene
  private let seed: UInt64
  /// The phases of all oscillations.
  private let phases: [Double]

  /// A video of `object`, whose walk depends on `seed`.
  package init(of object: DenseScene = .rich, seed: UInt64) {
    scene = object.scene(poses: [])
    self.seed = seed
    var random = SeededGenerator(seed: seed)
    phases = (0..<12).map { _ in 2 * .pi * random.uniform() }
  }

  package var frameCount: Int { Int(seconds * framesPerSecond) }

  package var object: Mesh { scene.object }

  /// The camera of all frames.
  package var camera: Camera {
    Camera(
      width: width, height: height, focalLength: SIMD2(repeating: 0.85 * Double(width)),
      calibration: .exif)
  }

  /// The time in the middle of the exposure of the middle row of a frame.
  package func middle(ofFrame index: Int) -> Double {
    Double(index) / framesPerSecond + (readout + exposure) / 2
  }

  /// `cameraFromWorld` at a time in seconds.
  package func pose(at time: Double) -> RigidTransform {
    func wave(_ number: Int, _ hertz: Double) -> Double {
      sin(2 * .pi * hertz * time + phases[number])
    }
    // One turn, at a speed that varies by 40 %.
    let turn = time / seconds + 0.4 / (2 * .pi * 3) * (wave(0, 3 / seconds) - sin(phases[0]))
    let degrees = 32 + 13 * wave(1, 2 / seconds)
    let steady = DenseScene.pose(turn: turn, degrees: degrees)
    // Steps move the camera by a centimeter, and the hand turns it by a third of a degree.
    let sway = SIMD3(wave(2, 0.9), wave(3, 1.8), wave(4, 0.7)) * 0.01
    let tremor = SIMD3(wave(5, 3.1) + wave(6, 1.1), wave(7, 2.7) + wave(8, 0.8), wave(9, 2.3))
    let angle = tremor.length * 0.3 * .pi / 180
    let shake = Quaternion(angle: angle, axis: angle > 0 ? tremor : [0, 1, 0])
    return RigidTransform(rotation: shake, translation: sway) * steady
  }

  /// Renders a frame, sRGB-encoded.
  package func frame(_ index: Int, _ control: KernelControl) throws -> RasterImage {
    let start = Double(index) / framesPerSecond
    return try render(index, control) { row, share in
      start + readout * Double(row) / Double(height) + exposure * share
    }
  }

  /// Renders what a still camera would show in the middle of a frame: no motion blur, all rows at
  /// once, and the same exposure.
  package func still(_ index: Int, _ control: KernelControl) throws -> RasterImage {
    let time = middle(ofFrame: index)
    return try render(index, control) { _, _ in time }
  }

  /// `time` is that of a sample of a row, by its place 0…1 in the exposure.
  private func render(
    _ index: Int, _ control: KernelControl, time: @Sendable (Int, Double) -> Double
  ) throws -> RasterImage {
    try withoutActuallyEscaping(time) { time in
      let camera = camera
      let gain = Float(pow(2, 0.4 * sin(2 * .pi * Double(index) / Double(frameCount) + phases[10])))
      let rows = try control.parallelMap(height) { row in
        var random = SplitMix64(
          seed: seed &* 1_000_003 &+ UInt64(index) &* 65_537 &+ UInt64(row))
        let poses = (0..<samples).map { sample in
          pose(at: time(row, (Double(sample) + 0.5) / Double(samples)))
        }
        return (0..<width).flatMap { column in
          var sum = SIMD3<Float>.zero
          for pose in poses {
            let place = SIMD2(Double(column) + random.uniform(), Double(row) + random.uniform())
            let ray = camera.unproject(place)
            let direction = pose.rotation.conjugate * SIMD3(ray.x, ray.y, 1)
            sum += scene.radiance(
              along: (SIMD3<Float>(pose.center), SIMD3<Float>(direction)))
          }
          return encoded(sum / Float(samples) * gain, noise: random.normal3() * scene.noise)
        }
      }
      return RasterImage(width: width, height: height, channels: 3, pixels: Array(rows.joined()))
    }
  }

  private func encoded(_ linear: SIMD3<Float>, noise: SIMD3<Double>) -> [UInt8] {
    (0..<3).map { channel in
      let value = 255 * RenderedScene.encode(Double(linear[channel])) + noise[channel]
      return UInt8(min(max(value.rounded(), 0), 255))
    }
  }
}
