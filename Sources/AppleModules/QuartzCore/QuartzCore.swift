// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The one function of this framework that programs without windows call.
@_exported import CoreFoundationTypes

/// The seconds since the machine was started, the time of its sleep left out.
public func CACurrentMediaTime() -> CFTimeInterval { ProcessInfo.processInfo.systemUptime }
