// swift-format-ignore-file: AlwaysUseLowerCamelCase, NeverUseImplicitlyUnwrappedOptionals
// The Core Foundation types in the signatures of CoreVideo, CoreGraphics and ImageIO, which
// Foundation on Linux does not export. They are aliases of Foundation's types, so that programs
// convert with `as`.
@_exported import Foundation

/// A string.
public typealias CFString = String
/// A dictionary with string keys.
public typealias CFDictionary = [String: Any]
/// An array.
public typealias CFArray = [Any]
/// A Boolean.
public typealias CFBoolean = Bool
/// A number of any type.
public typealias CFNumber = NSNumber
/// A URL.
public typealias CFURL = URL
/// Immutable bytes.
public typealias CFData = Data
/// Mutable bytes.
public typealias CFMutableData = NSMutableData

/// True.
public let kCFBooleanTrue: CFBoolean! = true
/// False.
public let kCFBooleanFalse: CFBoolean! = false

/// Calls a closure. On macOS it also drains an autorelease pool; there is none here.
public func autoreleasepool<Result>(
  invoking body: () throws -> Result
) rethrows -> Result { try body() }

/// A memory allocator; has no effect here.
public final class CFAllocator: Sendable {}

/// The default allocator.
public let kCFAllocatorDefault: CFAllocator! = nil

/// The default allocator by its system name.
public let kCFAllocatorSystemDefault: CFAllocator! = nil
