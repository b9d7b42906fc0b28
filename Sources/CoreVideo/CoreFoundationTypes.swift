// swift-format-ignore-file: AlwaysUseLowerCamelCase, NeverUseImplicitlyUnwrappedOptionals
// The types of Core Foundation that CoreVideo's signatures name. Foundation hides them here.
@_exported import Foundation

/// A text.
public typealias CFString = String
/// Values by name.
public typealias CFDictionary = [String: Any]
/// A truth value.
public typealias CFBoolean = Bool

/// True.
public let kCFBooleanTrue: CFBoolean! = true
/// False.
public let kCFBooleanFalse: CFBoolean! = false

/// A time span in seconds.
public typealias CFTimeInterval = Double
/// Seconds since the beginning of 2001.
public typealias CFAbsoluteTime = CFTimeInterval

/// The current time.
public func CFAbsoluteTimeGetCurrent() -> CFAbsoluteTime { Date().timeIntervalSinceReferenceDate }

/// Does some work. On a Mac, what it leaves behind for Objective-C is freed afterwards.
public func autoreleasepool<Result>(
  invoking body: () throws -> Result
) rethrows -> Result { try body() }

/// Provides memory.
public final class CFAllocator: Sendable {}

/// The default allocator, which has no effect.
public let kCFAllocatorDefault: CFAllocator! = nil
