import Foundation

/// A compute device.
///
/// Programs check these properties before they make models. There are no buffers, textures or
/// command queues here, since models are made on the CPU.
public protocol MTLDevice: AnyObject, Sendable {
  /// The name of the device.
  var name: String { get }
  /// A unique identifier of the device.
  var registryID: UInt64 { get }
  /// The architecture of the device.
  var architecture: MTLArchitecture { get }
  /// Where the device is located.
  var location: MTLDeviceLocation { get }
  /// The index of the device at its location.
  var locationNumber: Int { get }
  /// Whether the device is a low-power one.
  var isLowPower: Bool { get }
  /// Whether the device has no display output.
  var isHeadless: Bool { get }
  /// Whether the device can be removed.
  var isRemovable: Bool { get }
  /// Whether device and CPU share their memory.
  var hasUnifiedMemory: Bool { get }
  /// The recommended maximum size of the working set in bytes.
  var recommendedMaxWorkingSetSize: UInt64 { get }
  /// The allocated device memory in bytes.
  var currentAllocatedSize: Int { get }
  /// The maximum size of a buffer in bytes.
  var maxBufferLength: Int { get }
  /// The maximum transfer rate to device memory in bytes per second; 0 for shared memory.
  var maxTransferRate: UInt64 { get }
  /// The maximum number of threads per threadgroup, by dimension.
  var maxThreadsPerThreadgroup: MTLSize { get }
  /// The maximum threadgroup memory in bytes.
  var maxThreadgroupMemoryLength: Int { get }
  /// Whether ray tracing is supported.
  var supportsRaytracing: Bool { get }
  /// Whether ray tracing from render pipelines is supported.
  var supportsRaytracingFromRender: Bool { get }
  /// Whether function pointers are supported.
  var supportsFunctionPointers: Bool { get }
  /// Whether shaders can read barycentric coordinates.
  var supportsShaderBarycentricCoordinates: Bool { get }
  /// The former name of `supportsShaderBarycentricCoordinates`.
  var areBarycentricCoordsSupported: Bool { get }
  /// Whether textures of 32-bit floating-point numbers can be filtered.
  var supports32BitFloatFiltering: Bool { get }
  /// Whether BC-compressed textures are supported.
  var supportsBCTextureCompression: Bool { get }

  /// Whether sample positions are programmable.
  var areProgrammableSamplePositionsSupported: Bool { get }
  /// Whether raster order groups are supported.
  var areRasterOrderGroupsSupported: Bool { get }
  /// Whether shaders can query the level of detail of textures.
  var supportsQueryTextureLOD: Bool { get }
  /// Whether pull-model interpolation is supported.
  var supportsPullModelInterpolation: Bool { get }
  /// Whether multisampling of 32-bit formats is supported.
  var supports32BitMSAA: Bool { get }
  /// Whether dynamic libraries are supported.
  var supportsDynamicLibraries: Bool { get }
  /// Whether dynamic libraries are supported in render pipelines.
  var supportsRenderDynamicLibraries: Bool { get }
  /// Whether ray tracing supports primitive motion blur.
  var supportsPrimitiveMotionBlur: Bool { get }
  /// Whether the pixel format depth24Unorm_stencil8 is supported.
  var isDepth24Stencil8PixelFormatSupported: Bool { get }
  /// The tier of argument buffer support.
  var argumentBuffersSupport: MTLArgumentBuffersTier { get }
  /// The tier of read-write texture support.
  var readWriteTextureSupport: MTLReadWriteTextureTier { get }
  /// The peer group of the device; 0 if it has none.
  var peerGroupID: UInt64 { get }
  /// The index of the device in its peer group.
  var peerIndex: UInt32 { get }
  /// The number of devices in the peer group; 0 if there is none.
  var peerCount: UInt32 { get }
  /// A description of the device.
  var description: String { get }

  /// Whether the device supports all features of a GPU family.
  func supportsFamily(_ gpuFamily: MTLGPUFamily) -> Bool

  /// Whether a number of samples per pixel is supported.
  func supportsTextureSampleCount(_ sampleCount: Int) -> Bool

  /// Creates a command queue; nil here, since there are no commands to run.
  func makeCommandQueue() -> (any MTLCommandQueue)?
}

/// A queue of commands for a device.
public protocol MTLCommandQueue: AnyObject, Sendable {
  /// A label of the queue.
  var label: String? { get set }
  /// The device that executes the commands.
  var device: any MTLDevice { get }
}

/// The tier of argument buffer support.
public enum MTLArgumentBuffersTier: UInt, Hashable, Sendable {
  /// Basic support.
  case tier1
  /// Extended support.
  case tier2
}

/// The tier of read-write texture support.
public enum MTLReadWriteTextureTier: UInt, Hashable, Sendable {
  /// No support.
  case tierNone
  /// 32-bit formats.
  case tier1
  /// Most formats.
  case tier2
}

/// The architecture of a device.
public final class MTLArchitecture: Sendable {
  /// The name of the architecture.
  public let name: String

  init(name: String) { self.name = name }
}

/// Where a device is located.
public enum MTLDeviceLocation: UInt, Hashable, Sendable {
  /// Built into the machine.
  case builtIn
  /// In a slot of the machine.
  case slot
  /// Outside of the machine.
  case external
  /// Unknown.
  case unspecified = 0xFFFF_FFFF_FFFF_FFFF
}

/// A family of GPUs with common features.
public enum MTLGPUFamily: Int, Hashable, Sendable {
  /// Apple family 1.
  case apple1 = 1001
  /// Apple family 2.
  case apple2
  /// Apple family 3.
  case apple3
  /// Apple family 4.
  case apple4
  /// Apple family 5.
  case apple5
  /// Apple family 6.
  case apple6
  /// Apple family 7.
  case apple7
  /// Apple family 8.
  case apple8
  /// Apple family 9.
  case apple9
  /// Mac family 1.
  case mac1 = 2001
  /// Mac family 2.
  case mac2
  /// Common family 1.
  case common1 = 3001
  /// Common family 2.
  case common2
  /// Common family 3.
  case common3
  /// Mac Catalyst family 1.
  case macCatalyst1 = 4001
  /// Mac Catalyst family 2.
  case macCatalyst2
  /// Metal 3.
  case metal3 = 5001
  /// Metal 4.
  case metal4
}

/// The size of a grid.
public struct MTLSize: Sendable {
  /// The size along x.
  public var width: Int
  /// The size along y.
  public var height: Int
  /// The size along z.
  public var depth: Int

  /// Creates a size of zeros.
  public init() { self.init(width: 0, height: 0, depth: 0) }

  /// Creates a size from its dimensions.
  public init(width: Int, height: Int, depth: Int) {
    (self.width, self.height, self.depth) = (width, height, depth)
  }
}

/// Creates a size from its dimensions.
public func MTLSizeMake(_ width: Int, _ height: Int, _ depth: Int) -> MTLSize {
  MTLSize(width: width, height: height, depth: depth)
}
