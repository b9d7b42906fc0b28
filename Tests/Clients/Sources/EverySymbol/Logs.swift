import Foundation
import OSLog

/// Uses the older log functions and signposts.
func useLogs() {
  let log = OSLog(subsystem: "com.example.clients", category: "EverySymbol")
  os_log("%{public}@ has %d photos, %.1f MB (%%)", log: log, type: .info, "a folder", 20, 1.5)
  os_log(.debug, log: log, "%{private}@", "a secret")
  os_log("an interpolated message")
  os_log(.error, log: .default, "\(5, format: .hex)")
  check(!OSLog.disabled.isEnabled(type: .debug), "nothing is logged")
  Logger(log).notice("the same log")
  let points = OSLog(subsystem: "com.example.clients", category: OSLog.Category.pointsOfInterest)
  let id = OSSignpostID(log: points)
  os_signpost(.begin, log: points, name: "photos", signpostID: id)
  os_signpost(OSSignpostType.end, log: points, name: "photos", signpostID: id, "%d read", 20)
  let signposter = OSSignposter(subsystem: "com.example.clients", category: .pointsOfInterest)
  check(!OSSignposter.disabled.isEnabled, "off")
  let state = signposter.beginInterval("model", id: signposter.makeSignpostID())
  check(![.null, .invalid, .exclusive].contains(state.signpostID), "a unique interval")
  signposter.emitEvent("face", "\(1)")
  signposter.endInterval("model", state)
  let sum = signposter.withIntervalSignpost("sum") { (1...3).reduce(0, +) }
  check(sum == 6, "the closure ran")
}
