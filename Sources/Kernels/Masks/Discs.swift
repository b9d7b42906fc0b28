import CKernels
import SceneModel

/// Points that are drawn into photos as discs, each with a label above 0.
package struct Discs: Sendable {
  /// World frame.
  package var positions: [SIMD3<Float>]
  /// In world units.
  package var radii: [Float]
  package var labels: [UInt8]

  package init(positions: [SIMD3<Float>], radii: [Float], labels: [UInt8]) {
    self.positions = positions
    self.radii = radii
    self.labels = labels
  }

  /// The label of the nearest disc at every pixel of a photo, 0 where there is none (surface
  /// splatting with a depth buffer). The result is gray and has the size of the camera.
  package func drawn(
    by camera: Camera, at cameraFromWorld: RigidTransform, _ control: KernelControl
  ) throws -> RasterImage {
    guard radii.count == positions.count, labels.count == positions.count else {
      throw KernelError.invalidArgument("every disc needs a radius and a label")
    }
    var result = RasterImage(width: camera.width, height: camera.height, channels: 1)
    var (rawCamera, pose) = (ck_camera(camera), ck_pose(cameraFromWorld))
    try withKernel(control) { control in
      positions.withSpan { positions in
        radii.withUnsafeBufferPointer { radii in
          labels.withUnsafeBufferPointer { labels in
            var discs = ck_discs(
              positions: positions, radii: radii.baseAddress, labels: labels.baseAddress)
            return result.withMutableKernelPixels {
              ck_draw_discs(&discs, &rawCamera, &pose, control, $0)
            }
          }
        }
      }
    }
    return result
  }
}
