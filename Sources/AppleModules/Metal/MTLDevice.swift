import Foundation

/// A device that computes.
///
/// Programs look at these properties before they make models; there are no buffers, textures and
/// command queues here, since the models are made by the processor.
public protocol MTLDevice: AnyObject, Sendable {
  /// The name of the device.
  var name: String { get }
  /// A number of the device's own.
  var registryID: UInt64 { get }
  /// The kind of the device.
  var architecture: MTLArchitecture { get }
  /// Where the device is.
  var location: MTLDeviceLocation { get }
  /// Its number among those at the same place.
  var locationNumber: Int { get }
  /// Whether the device saves power at the cost of speed.
  var isLowPower: Bool { get }
  /// Whether no display can be connected to the device.
  var isHeadless: Bool { get }
  /// Whether the device can be taken out.
  var isRemovable: Bool { get }
  /// Whether device and processor share their memory.
  var hasUnifiedMemory: Bool { get }
  /// The bytes of memory that the device works well with.
  var recommendedMaxWorkingSetSize: UInt64 { get }
  /// The bytes of memory that are in use on the device.
  var currentAllocatedSize: Int { get }
  /// The bytes that a buffer has at most.
  var maxBufferLength: Int { get }
  /// The bytes a second to the memory of the device; 0 where it shares the processor's.
  var maxTransferRate: UInt64 { get }
  /// The threads of a group at most, by dimension.
  var maxThreadsPerThreadgroup: MTLSize { get }
  /// The bytes that the threads of a group share at most.
  var maxThreadgroupMemoryLength: Int { get }
  /// Whether rays can be cast.
  var supportsRaytracing: Bool { get }
  /// Whether rays can be cast while drawing.
  var supportsRaytracingFromRender: Bool { get }
  /// Whether functions can be handed to functions.
  var supportsFunctionPointers: Bool { get }
  /// Whether a place in a triangle is known where it is drawn.
  var supportsShaderBarycentricCoordinates: Bool { get }
  /// The former name of `supportsShaderBarycentricCoordinates`.
  var areBarycentricCoordsSupported: Bool { get }
  /// Whether textures of 32-bit floating-point numbers can be filtered.
  var supports32BitFloatFiltering: Bool { get }
  /// Whether BC-compressed textures can be read.
  var supportsBCTextureCompression: Bool { get }

  /// Whether the samples of a pixel have places of their own.
  var areProgrammableSamplePositionsSupported: Bool { get }
  /// Whether the parts of a drawing can wait for each other by pixel.
  var areRasterOrderGroupsSupported: Bool { get }
  /// Whether textures tell which of their sizes is read.
  var supportsQueryTextureLOD: Bool { get }
  /// Whether values in a triangle are known at any place.
  var supportsPullModelInterpolation: Bool { get }
  /// Whether 32-bit numbers have several samples a pixel.
  var supports32BitMSAA: Bool { get }
  /// Whether programs of the device are put together when they run.
  var supportsDynamicLibraries: Bool { get }
  /// Whether programs that draw are put together when they run.
  var supportsRenderDynamicLibraries: Bool { get }
  /// Whether rays meet what moves.
  var supportsPrimitiveMotionBlur: Bool { get }
  /// Whether depth of 24 bits is known.
  var isDepth24Stencil8PixelFormatSupported: Bool { get }
  /// How well arguments can be put into buffers.
  var argumentBuffersSupport: MTLArgumentBuffersTier { get }
  /// Which textures can be read and written at once.
  var readWriteTextureSupport: MTLReadWriteTextureTier { get }
  /// The group of devices that exchange memory; 0 where there is none.
  var peerGroupID: UInt64 { get }
  /// The number of the device in its group.
  var peerIndex: UInt32 { get }
  /// The devices of the group; 0 where there is none.
  var peerCount: UInt32 { get }
  /// A sentence about the device.
  var description: String { get }

  /// Whether the device can do what all of a family can.
  func supportsFamily(_ gpuFamily: MTLGPUFamily) -> Bool

  /// Whether pixels can have so many samples.
  func supportsTextureSampleCount(_ sampleCount: Int) -> Bool

  /// Makes a queue of commands, where the device takes commands. This one doesn't: nil.
  func makeCommandQueue() -> (any MTLCommandQueue)?
}

/// Where the commands of a device wait.
public protocol MTLCommandQueue: AnyObject, Sendable {
  /// A name of the queue.
  var label: String? { get set }
  /// The device that takes the commands.
  var device: any MTLDevice { get }
}

/// How well a device can put arguments into buffers.
public enum MTLArgumentBuffersTier: UInt, Hashable, Sendable {
  /// Some.
  case tier1
  /// All.
  case tier2
}

/// Which textures a device reads and writes at once.
public enum MTLReadWriteTextureTier: UInt, Hashable, Sendable {
  /// None.
  case tierNone
  /// Those of 32 bits.
  case tier1
  /// Most.
  case tier2
}

/// The kind of a device.
public final class MTLArchitecture: Sendable {
  /// The name of the kind.
  public let name: String

  init(name: String) { self.name = name }
}

/// Where a device is.
public enum MTLDeviceLocation: UInt, Hashable, Sendable {
  /// In the machine's case, for good.
  case builtIn
  /// In a slot of the machine.
  case slot
  /// Outside of the machine.
  case external
  /// It can't be told.
  case unspecified = 0xFFFF_FFFF_FFFF_FFFF
}

/// A group of devices that can do the same.
public enum MTLGPUFamily: Int, Hashable, Sendable {
  /// Apple's first generation.
  case apple1 = 1001
  /// Apple's second generation.
  case apple2
  /// Apple's third generation.
  case apple3
  /// Apple's fourth generation.
  case apple4
  /// Apple's fifth generation.
  case apple5
  /// Apple's sixth generation.
  case apple6
  /// Apple's seventh generation.
  case apple7
  /// Apple's eighth generation.
  case apple8
  /// Apple's ninth generation.
  case apple9
  /// The first generation on the Mac.
  case mac1 = 2001
  /// The second generation on the Mac.
  case mac2
  /// What all devices can do.
  case common1 = 3001
  /// What most devices can do.
  case common2
  /// What newer devices can do.
  case common3
  /// The first generation of the Mac with programs of the iPad.
  case macCatalyst1 = 4001
  /// The second generation of the Mac with programs of the iPad.
  case macCatalyst2
  /// What Metal 3 needs.
  case metal3 = 5001
  /// What Metal 4 needs.
  case metal4
}

/// The extent of a grid.
public struct MTLSize: Sendable {
  /// The extent along x.
  public var width: Int
  /// The extent along y.
  public var height: Int
  /// The extent along z.
  public var depth: Int

  /// Creates an empty extent.
  public init() { self.init(width: 0, height: 0, depth: 0) }

  /// Creates an extent from its sides.
  public init(width: Int, height: Int, depth: Int) {
    (self.width, self.height, self.depth) = (width, height, depth)
  }
}

/// Creates an extent from its sides.
public func MTLSizeMake(_ width: Int, _ height: Int, _ depth: Int) -> MTLSize {
  MTLSize(width: width, height: height, depth: depth)
}
