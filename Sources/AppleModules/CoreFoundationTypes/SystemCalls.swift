import Foundation

// Calls whose constants are of another type in the Mac's C library.

/// Asks the terminal for its size: `ioctl(STDOUT_FILENO, TIOCGWINSZ, &size)`.
@discardableResult public func ioctl(
  _ descriptor: Int32, _ request: Int32, _ size: inout winsize
) -> Int32 { ioctl(descriptor, UInt(request), &size) }

/// Asks what the process has used: `getrusage(RUSAGE_SELF, &usage)`. Its `ru_maxrss` is in kilobytes,
/// and not in bytes as on a Mac.
@discardableResult public func getrusage(
  _ who: __rusage_who, _ usage: inout rusage
) -> Int32 { getrusage(__rusage_who_t(who.rawValue), &usage) }
