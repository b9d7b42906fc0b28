import Foundation
import Metal
import RealityKit
import os

/// Uses the log, locks and devices.
func useMachine() {
  let logger = Logger(subsystem: "com.example.clients", category: "EverySymbol")
  let (name, number, share) = ("log", 255, 0.5)
  Logger().trace("\(name)")
  logger.debug("\(number, format: .hex(includePrefix: true), align: .right(columns: 6))")
  logger.info("\(share, format: .fixed(precision: 1), privacy: .public)")
  logger.notice("\(name, align: .left(columns: 5), privacy: .private(mask: .hash))")
  logger.warning("\(true, format: .answer) \(number, format: .octal, privacy: .sensitive)")
  logger.error("\(CocoaError(.fileNoSuchFile) as any Error) \(Session.self)")
  logger.critical("\(Float(1), format: .exponential) \(CGFloat(2), format: .hybrid)")
  logger.fault("\(number, format: .decimal(minDigits: 5)) \([1, 2])")
  let levels: [OSLogType] = [.default, .info, .debug, .error, .fault]
  for level in levels { logger.log(level: level, "\(level.rawValue)") }
  logger.log("a message without values")
  useMessages(logger)
  let lock = OSAllocatedUnfairLock(initialState: 1)
  lock.withLock { $0 += 1 }
  check(lock.withLockUnchecked { $0 } == 2 && lock.withLockIfAvailable { $0 } == 2, "locks")
  let plain = OSAllocatedUnfairLock()
  plain.lock()
  check(!plain.lockIfAvailable(), "locked")
  plain.unlock()

  let devices: [any MTLDevice] = MTLCopyAllDevices()
  check(devices.contains { $0 === MTLCreateSystemDefaultDevice() }, "the default is a device")
  for device in devices {
    check(!device.isLowPower && !device.isRemovable && device.hasUnifiedMemory, "capable")
    check(device.supportsRaytracing && device.supportsRaytracingFromRender, "rays")
    check(device.areBarycentricCoordsSupported, "barycentric coordinates")
    check(device.supportsShaderBarycentricCoordinates && device.supportsFunctionPointers, "shaders")
    check(device.supports32BitFloatFiltering && device.supportsBCTextureCompression, "textures")
    check(device.supportsFamily(.metal3) && device.supportsFamily(MTLGPUFamily.common3), "families")
    check(device.location == MTLDeviceLocation.builtIn && device.locationNumber == 0, "location")
    let size: MTLSize = device.maxThreadsPerThreadgroup
    check(size.width * size.height * size.depth > MTLSizeMake(1, 1, 1).width, "threads")
    print(
      device.name, device.registryID, device.architecture.name, device.isHeadless,
      device.recommendedMaxWorkingSetSize, device.currentAllocatedSize, device.maxBufferLength,
      device.maxTransferRate, device.maxThreadgroupMemoryLength)
  }
  let limits: Session.Limits = Session.limits
  check(limits.maximumInputImageDimension >= 8192, "dimension")
  check(limits.maximumNumberOfInputImages >= 100 && Session.isSupported, "photos")
}

/// Uses the parts of log messages.
private func useMessages(_ logger: Logger) {
  var interpolation = OSLogInterpolation(literalCapacity: 5, interpolationCount: 5)
  interpolation.appendLiteral("parts ")
  let privacies: [OSLogPrivacy] = [.auto, .public, .auto(mask: OSLogPrivacy.Mask.none)]
  let alignment: OSLogStringAlignment = .none
  let integers: OSLogIntegerFormatting = .decimal
  let floats: OSLogFloatFormatting = .fixed
  let truth: OSLogBoolFormat = .truth
  for privacy in privacies {
    interpolation.appendInterpolation("x", align: alignment, privacy: privacy)
  }
  interpolation.appendInterpolation(5, format: integers)
  interpolation.appendInterpolation(0.5, format: floats)
  interpolation.appendInterpolation(true, format: truth)
  let message = OSLogMessage(stringInterpolation: interpolation)
  check("\(message.interpolation)".count > 5, "a message has its interpolation")
  logger.log(message)
}
