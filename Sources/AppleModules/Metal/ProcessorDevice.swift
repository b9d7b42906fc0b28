// swift-format-ignore-file: AlwaysUseLowerCamelCase
import Foundation

/// The device of this machine: the CPU, which makes the models.
public func MTLCreateSystemDefaultDevice() -> (any MTLDevice)? { ProcessorDevice.shared }

/// All devices: the CPU only.
public func MTLCopyAllDevices() -> [any MTLDevice] { [ProcessorDevice.shared] }

/// The CPU posing as a GPU: deliberately reports every capability as supported, although it runs no
/// Metal commands.
///
/// Programs check these properties to decide whether Object Capture can run. It runs on the CPU
/// here, so every check must pass. Whether this machine has enough memory is what
/// `PhotogrammetrySession.isSupported` reports.
final class ProcessorDevice: MTLDevice, CustomStringConvertible {
  static let shared = ProcessorDevice()

  let name = "Processor"
  let registryID: UInt64 = 1
  let architecture = MTLArchitecture(name: "processor")
  let location = MTLDeviceLocation.builtIn
  let locationNumber = 0
  let isLowPower = false
  let isHeadless = true
  let isRemovable = false
  let hasUnifiedMemory = true
  let currentAllocatedSize = 0
  let maxTransferRate: UInt64 = 0
  let maxThreadgroupMemoryLength = 32_768
  let supportsRaytracing = true
  let supportsRaytracingFromRender = true
  let supportsFunctionPointers = true
  let supportsShaderBarycentricCoordinates = true
  let areBarycentricCoordsSupported = true
  let supports32BitFloatFiltering = true
  let supportsBCTextureCompression = true
  let areProgrammableSamplePositionsSupported = true
  let areRasterOrderGroupsSupported = true
  let supportsQueryTextureLOD = true
  let supportsPullModelInterpolation = true
  let supports32BitMSAA = true
  let supportsDynamicLibraries = true
  let supportsRenderDynamicLibraries = true
  let supportsPrimitiveMotionBlur = true
  let isDepth24Stencil8PixelFormatSupported = true
  let argumentBuffersSupport = MTLArgumentBuffersTier.tier2
  let readWriteTextureSupport = MTLReadWriteTextureTier.tier2
  let peerGroupID: UInt64 = 0
  let peerIndex: UInt32 = 0
  let peerCount: UInt32 = 0

  var description: String { "<MTLDevice: \(name)>" }

  var maxThreadsPerThreadgroup: MTLSize { MTLSizeMake(1024, 1024, 1024) }

  /// The memory of the machine, but at least the 4 GB of GPU memory that Object Capture requires on
  /// macOS: this engine needs less, so the check must not fail.
  var recommendedMaxWorkingSetSize: UInt64 {
    max(ProcessInfo.processInfo.physicalMemory, 4 << 30)
  }

  var maxBufferLength: Int { Int(clamping: recommendedMaxWorkingSetSize / 2) }

  func supportsFamily(_ gpuFamily: MTLGPUFamily) -> Bool { true }

  func supportsTextureSampleCount(_ sampleCount: Int) -> Bool {
    [1, 2, 4, 8].contains(sampleCount)
  }

  func makeCommandQueue() -> (any MTLCommandQueue)? { nil }
}
