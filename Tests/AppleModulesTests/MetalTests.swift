import Foundation
import Metal
import Testing

@Suite struct MetalTests {
  @Test func theDevicePassesEveryCapabilityCheck() throws {
    let device = try #require(MTLCreateSystemDefaultDevice())
    let devices = MTLCopyAllDevices()
    #expect(devices.count == 1 && devices.first === device)
    #expect(!device.isLowPower && device.areBarycentricCoordsSupported)
    #expect(device.recommendedMaxWorkingSetSize >= UInt64(4e9) && device.supportsRaytracing)
    #expect(device.supportsFamily(.metal3) && device.supportsFamily(.apple7))
    #expect(device.maxBufferLength > 0 && !device.name.isEmpty && device.registryID != 0)
  }

  @Test func workingSetIsTheMachinesMemory() throws {
    let device = try #require(MTLCreateSystemDefaultDevice())
    let memory = ProcessInfo.processInfo.physicalMemory
    #expect(device.recommendedMaxWorkingSetSize == max(memory, 4 << 30))
    #expect(device.hasUnifiedMemory && !device.isRemovable)
  }

  @Test func enumerationsHaveApplesRawValues() {
    #expect(MTLGPUFamily.apple9.rawValue == 1009 && MTLGPUFamily.mac2.rawValue == 2002)
    #expect(MTLGPUFamily.common3.rawValue == 3003 && MTLGPUFamily.metal4.rawValue == 5002)
    #expect(MTLDeviceLocation.external.rawValue == 2)
  }
}
