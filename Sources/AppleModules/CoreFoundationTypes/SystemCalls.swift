import Foundation

// System calls whose constants have another type in the macOS C library.

/// Queries the terminal size: `ioctl(STDOUT_FILENO, TIOCGWINSZ, &size)`.
@discardableResult public func ioctl(
  _ descriptor: Int32, _ request: Int32, _ size: inout winsize
) -> Int32 { ioctl(descriptor, UInt(request), &size) }

/// Queries the resource usage of the process: `getrusage(RUSAGE_SELF, &usage)`. Its `ru_maxrss` is
/// in kilobytes, not in bytes as on macOS.
@discardableResult public func getrusage(
  _ who: __rusage_who, _ usage: inout rusage
) -> Int32 { getrusage(__rusage_who_t(who.rawValue), &usage) }
