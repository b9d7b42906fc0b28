// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The one function of QuartzCore that programs without windows call.
@_exported import CoreFoundationTypes

/// The seconds since the machine was started, excluding sleep.
public func CACurrentMediaTime() -> CFTimeInterval { ProcessInfo.processInfo.systemUptime }
