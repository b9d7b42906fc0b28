// swift-format-ignore-file: AlwaysUseLowerCamelCase, NeverUseImplicitlyUnwrappedOptionals
// The types of Core Foundation that CoreVideo, CoreGraphics and ImageIO name in their signatures.
// Foundation hides them here. They are Foundation's own types, so that programs bridge with `as`.
@_exported import Foundation

/// A text.
public typealias CFString = String
/// Values by name.
public typealias CFDictionary = [String: Any]
/// Values in their order.
public typealias CFArray = [Any]
/// A truth value.
public typealias CFBoolean = Bool
/// A number of any kind.
public typealias CFNumber = NSNumber
/// A place of a file.
public typealias CFURL = URL
/// Bytes.
public typealias CFData = Data
/// Bytes that may change.
public typealias CFMutableData = NSMutableData

/// True.
public let kCFBooleanTrue: CFBoolean! = true
/// False.
public let kCFBooleanFalse: CFBoolean! = false

/// Does some work. On a Mac, what it leaves behind for Objective-C is freed afterwards.
public func autoreleasepool<Result>(
  invoking body: () throws -> Result
) rethrows -> Result { try body() }

/// Provides memory.
public final class CFAllocator: Sendable {}

/// The default allocator, which has no effect.
public let kCFAllocatorDefault: CFAllocator! = nil

/// The same allocator by its full name.
public let kCFAllocatorSystemDefault: CFAllocator! = nil
