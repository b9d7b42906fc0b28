import Foundation
import Metal
import QuartzCore
import RealityKit
import UniformTypeIdentifiers
import os
import os.lock
import os.signpost

/// Uses the system interfaces for long work.
func useSystem(_ photo: URL) throws {
  let process = ProcessInfo.processInfo
  let options: [ProcessInfo.ActivityOptions] = [
    .userInitiated, .userInitiatedAllowingIdleSystemSleep, .background, .latencyCritical,
    .idleDisplaySleepDisabled, .idleSystemSleepDisabled, .suddenTerminationDisabled,
    .automaticTerminationDisabled,
  ]
  check(Set(options.map(\.rawValue)).count == options.count, "options")
  let activity = process.beginActivity(options: options[0], reason: "a model")
  process.endActivity(activity)
  process.disableSuddenTermination()
  var isDone = false
  process.performActivity(options: .background, reason: "less") { isDone = true }
  process.enableSuddenTermination()
  check(isDone && !process.isLowPowerModeEnabled, "activities")
  let heat: [ProcessInfo.ThermalState] = [.nominal, .fair, .serious, .critical]
  check(heat.contains(process.thermalState), "heat")
  check("\(ProcessInfo.thermalStateDidChangeNotification.rawValue)".count > 5, "a name")
  check(CACurrentMediaTime() > 0, "time advances")
  var size = winsize()
  _ = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size)
  var usage = rusage()
  check(getrusage(RUSAGE_SELF, &usage) == 0 && usage.ru_maxrss > 0, "memory")
  let values = try photo.resourceValues(forKeys: [
    .contentTypeKey, .volumeAvailableCapacityForImportantUsageKey,
    .volumeAvailableCapacityForOpportunisticUsageKey,
  ])
  check(values.contentType == .jpeg, "a content type")
  check(values.volumeAvailableCapacityForImportantUsage ?? 0 > 0, "space")
  check(values.volumeAvailableCapacityForOpportunisticUsage ?? 0 > 0, "more space")
  useLocks()
  useDevice()
}

private func useLocks() {
  var lock: os_unfair_lock_s = os_unfair_lock()
  os_unfair_lock_lock(&lock)
  os_unfair_lock_assert_owner(&lock)
  check(!os_unfair_lock_trylock(&lock), "locked")
  os_unfair_lock_unlock(&lock)
  os_unfair_lock_assert_not_owner(&lock)
  let shared = os_unfair_lock_t.allocate(capacity: 1)
  shared.initialize(to: os_unfair_lock())
  nonisolated(unsafe) let (word, sum) = (shared, UnsafeMutablePointer<Int>.allocate(capacity: 1))
  sum.initialize(to: 0)
  DispatchQueue.concurrentPerform(iterations: 1000) { _ in
    os_unfair_lock_lock(word)
    sum.pointee += 1
    os_unfair_lock_unlock(word)
  }
  check(sum.pointee == 1000, "mutual exclusion")
  sum.deallocate()
  shared.deallocate()
  let guarded = OSAllocatedUnfairLock(initialState: 0)
  guarded.precondition(OSAllocatedUnfairLock<Int>.Ownership.notOwner)
  guarded.withLockUnchecked { _ in guarded.precondition(.owner) }
  check(!OSLog.disabled.signpostsEnabled, "no signposts")
}

private func useDevice() {
  guard let device = MTLCreateSystemDefaultDevice() else { return check(false, "a device") }
  check(device.areRasterOrderGroupsSupported && device.supports32BitMSAA, "drawing")
  check(device.areProgrammableSamplePositionsSupported && device.supportsQueryTextureLOD, "samples")
  check(device.supportsPullModelInterpolation && device.supportsPrimitiveMotionBlur, "triangles")
  check(device.supportsDynamicLibraries && device.supportsRenderDynamicLibraries, "libraries")
  check(device.isDepth24Stencil8PixelFormatSupported, "depth")
  check(device.argumentBuffersSupport == MTLArgumentBuffersTier.tier2, "arguments")
  check(device.readWriteTextureSupport == MTLReadWriteTextureTier.tier2, "textures")
  check(device.peerGroupID == 0 && device.peerIndex == 0 && device.peerCount == 0, "alone")
  check(device.supportsTextureSampleCount(4) && device.supportsFamily(.macCatalyst2), "counts")
  check(device.description.contains(device.name), "a description")
  let queue: (any MTLCommandQueue)? = device.makeCommandQueue()
  check(queue?.label == nil && queue?.device == nil, "no commands")
}
