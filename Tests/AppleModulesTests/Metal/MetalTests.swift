import Foundation
import Metal
import Testing

@Suite struct MetalTests {
  private func device() throws -> any MTLDevice { try #require(MTLCreateSystemDefaultDevice()) }

  @Test func theProcessorIsTheOnlyDevice() throws {
    let (device, devices) = (try device(), MTLCopyAllDevices())
    #expect(devices.count == 1 && devices.first === device)
    #expect(device.name == "Processor" && device.description == "<MTLDevice: Processor>")
    #expect(device.registryID == 1 && device.architecture.name == "processor")
    #expect(device.location == .builtIn && device.locationNumber == 0)
  }

  @Test func capabilityChecksOfObjectCapturePass() throws {
    let device = try device()
    #expect(!device.isLowPower && device.areBarycentricCoordsSupported)
    #expect(device.recommendedMaxWorkingSetSize >= UInt64(4e9) && device.supportsRaytracing)
    #expect(device.supportsFamily(.metal3) && device.supportsFamily(.apple7))
  }

  /// The figure of the kernel in bytes, read independently of Foundation.
  private func installedMemory() throws -> UInt64 {
    let lines = try String(contentsOfFile: "/proc/meminfo", encoding: .utf8).split(separator: "\n")
    let line = try #require(lines.first { $0.hasPrefix("MemTotal:") })
    return try #require(line.split(separator: " ").dropFirst().first.flatMap { UInt64($0) }) * 1024
  }

  @Test func workingSetIsTheInstalledMemory() throws {
    let (device, memory) = (try device(), try installedMemory())
    let size = device.recommendedMaxWorkingSetSize
    #expect(Double(size) > 0.99 * Double(memory))
    // Small machines report the 4 GiB that capability checks require.
    #expect(size == 4_294_967_296 || Double(size) < 1.01 * Double(memory))
    #expect(device.hasUnifiedMemory && !device.isRemovable && device.maxTransferRate == 0)
  }

  @Test func buffersFitIntoTheWorkingSet() throws {
    let device = try device()
    #expect(device.maxBufferLength >= 2_147_483_648)
    #expect(UInt64(device.maxBufferLength) <= device.recommendedMaxWorkingSetSize)
  }

  @Test func onlyPowersOfTwoUpToEightAreSampleCounts() throws {
    let device = try device()
    #expect((0...16).filter { device.supportsTextureSampleCount($0) } == [1, 2, 4, 8])
  }

  @Test func thereAreNoCommandQueues() throws {
    #expect(try device().makeCommandQueue() == nil)
  }

  @Test func sizesHaveThreeSides() {
    let size = MTLSizeMake(2, 3, 4)
    #expect(size.width == 2 && size.height == 3 && size.depth == 4)
    #expect(MTLSize().width == 0 && MTLSize().depth == 0)
  }

  @Test func enumerationsHaveApplesRawValues() {
    #expect(MTLGPUFamily.apple9.rawValue == 1009 && MTLGPUFamily.mac2.rawValue == 2002)
    #expect(MTLGPUFamily.common3.rawValue == 3003 && MTLGPUFamily.metal4.rawValue == 5002)
    #expect(MTLDeviceLocation.external.rawValue == 2)
    #expect(MTLDeviceLocation.unspecified.rawValue == UInt64.max)
    #expect(
      MTLArgumentBuffersTier.tier2.rawValue == 1 && MTLReadWriteTextureTier.tier2.rawValue == 2)
  }
}
