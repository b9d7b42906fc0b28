import Foundation
import Kernels

/// Results of parts of a stage that several processes make for each other: a folder of sealed
/// files.
///
/// The name of a file contains the fingerprint of everything that the result depends on. So a
/// result is found wherever it was made and whoever asks for it, and a damaged one counts as
/// missing.
struct UnitStore: Sendable {
  /// What a result is: the start of its file's name.
  enum Kind: String, Sendable {
    case inspections, photos, features, candidates, promising, pairs, matches, morePairs
    case scene, viewPoints, sceneSamples, observed, occluders, tileBase, tileSamples, solvedTile,
      writtenTile
  }

  let folder: URL
  /// Whether missing results are written once they are made: by a process that makes a part of the
  /// work, but not by one that makes the rest of it at once.
  let isWritten: Bool

  /// The result of `make`, or what a process sealed before that made it from the same input. Throws
  /// what `make` throws, and `OutputError` if the result can't be written.
  func value<Value: UnitValue>(
    _ kind: Kind, madeFrom fingerprint: UInt64, _ make: () throws -> Value
  ) throws -> Value {
    if let found: Value = find(kind, madeFrom: fingerprint) { return found }
    let value = try make()
    try save(value, kind, madeFrom: fingerprint)
    return value
  }

  /// Seals a result, if results are written. Throws `OutputError`.
  func save(_ value: some UnitValue, _ kind: Kind, madeFrom fingerprint: UInt64) throws {
    guard isWritten else { return }
    try SealedFile.write(
      try value.unitData(), madeFrom: key(fingerprint), to: file(kind, fingerprint))
  }

  /// A result that was sealed before; nil if there is none.
  func find<Value: UnitValue>(_ kind: Kind, madeFrom fingerprint: UInt64) -> Value? {
    SealedFile.read(file(kind, fingerprint), madeFrom: key(fingerprint)).flatMap(Value.init(unit:))
  }

  private func file(_ kind: Kind, _ fingerprint: UInt64) -> URL {
    let name = "\(kind.rawValue)-\(key(fingerprint).hexadecimalDigits)"
    return folder.appendingPathComponent(name, isDirectory: false)
  }

  /// Other builds of the program may make other results.
  private func key(_ fingerprint: UInt64) -> UInt64 {
    var key = Fingerprint()
    key.add(ProgramIdentity.fingerprint)
    key.add(fingerprint)
    return key.value
  }
}
