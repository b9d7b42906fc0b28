import CKernels
import Kernels
import SceneModel
import Testing

/// Kernels run in the processes of client programs and do not change settings of the process.
@Suite struct HostProcessTests {
  @Test func kernelsLeaveLoggingAlone() throws {
    let image = RasterImage(width: 64, height: 48, channels: 3)
    _ = try image.resized(width: 32, height: 24)
    _ = try FeatureDetection().features(in: image, KernelControl())
    #expect(ck_test_is_logging())
  }
}
