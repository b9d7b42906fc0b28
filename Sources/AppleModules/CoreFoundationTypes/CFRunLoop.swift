// Command-line programs for macOS wait in `CFRunLoopRun()` and measure time with Core Foundation,
// which Foundation re-exports there. Only these names are re-exported here: the other types of Core
// Foundation can't be bridged on Linux.
@_exported import typealias CoreFoundation.CFAbsoluteTime
@_exported import func CoreFoundation.CFAbsoluteTimeGetCurrent
@_exported import class CoreFoundation.CFRunLoop
@_exported import func CoreFoundation.CFRunLoopGetCurrent
@_exported import func CoreFoundation.CFRunLoopGetMain
@_exported import func CoreFoundation.CFRunLoopRun
@_exported import func CoreFoundation.CFRunLoopStop
@_exported import typealias CoreFoundation.CFTimeInterval
