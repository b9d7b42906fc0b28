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

/// Provides memory.
public final class CFAllocator: Sendable {}

/// The default allocator, which has no effect.
public let kCFAllocatorDefault: CFAllocator! = nil
