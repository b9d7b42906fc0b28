import Formats
import Foundation
import Kernels

/// A file with a checksum and the fingerprint of everything that it was made from.
///
/// A file that is truncated, damaged or made from other input counts as missing. Numbers are
/// little-endian.
enum SealedFile {
  /// "STAGES01" in ASCII. The header is this number, the fingerprint, the byte count and the
  /// checksum of the payload.
  private static let magic: UInt64 = 0x3130_5345_4741_5453
  private static let headerCount = 4 * MemoryLayout<UInt64>.size

  /// Writes the file atomically; throws `OutputError`.
  static func write(_ payload: Data, madeFrom fingerprint: UInt64, to url: URL) throws {
    let header = [magic, fingerprint, UInt64(payload.count), checksum(payload, fingerprint)]
      .map(\.littleEndian)
    try header.withUnsafeBytes { header in
      try payload.withUnsafeBytes { try AtomicFile.write([header, $0], to: url) }
    }
  }

  /// The payload; nil if the file is missing, damaged or made from other input.
  static func read(_ url: URL, madeFrom fingerprint: UInt64) -> Data? {
    guard let data = FileManager.default.contents(atPath: url.path), data.count >= headerCount
    else { return nil }
    let words = (0..<4).map { index in
      data.withUnsafeBytes {
        UInt64(littleEndian: $0.loadUnaligned(fromByteOffset: 8 * index, as: UInt64.self))
      }
    }
    let payload = data.dropFirst(headerCount)
    guard words[0] == magic, words[1] == fingerprint, words[2] == UInt64(payload.count),
      words[3] == checksum(payload, fingerprint)
    else { return nil }
    return Data(payload)
  }

  private static func checksum(_ payload: Data, _ fingerprint: UInt64) -> UInt64 {
    payload.withUnsafeBytes { XXHash64.hash($0, seed: fingerprint) }
  }
}
