import Formats
import Foundation
import Kernels
import SceneModel

/// A folder with the intermediate results of the dense stage, one file per view and step.
///
/// ```
/// 0012.view             the photo without distortion, RGB
/// 0012.coarse           its patches at half the resolution
/// 0012.coarseStates     which of them passed the filter
/// 0012.coarseCompleted  the same, with holes filled and the patches at edges re-estimated
/// 0012.patches          the patches at the view's resolution
/// 0012.states           which of them passed the filter
/// 0012.completed        the same, completed like the coarse ones
/// 0012.completedStates  which of those passed the filter
/// 0012.cloud            its points of the fused cloud
/// ```
/// A file exists completely or not at all, and contains the fingerprint of all its inputs: one that
/// is truncated, damaged, or made from other photos, cameras, options or by another program counts
/// as missing. Several processes may work in one folder. Files may be deleted at any time between
/// runs. Numbers are in native byte order, detected from the magic number.
final class PatchWorkspace: Sendable {
  /// A step whose results are stored, in order of execution.
  enum Step: String, CaseIterable, Sendable {
    case view
    case coarse, coarseStates, coarseCompleted
    case patches, states, completed, completedStates
    case cloud

    /// At half the view's resolution.
    var isCoarse: Bool { self == .coarse || self == .coarseStates || self == .coarseCompleted }

    /// The steps whose files, of a view and its sources, this step reads.
    var inputs: [Step] {
      switch self {
      case .view: []
      case .coarse: [.view]
      case .coarseStates: [.view, .coarse]
      case .coarseCompleted: [.view, .coarse, .coarseStates]
      case .patches: [.view, .coarseCompleted]
      case .states: [.view, .patches]
      case .completed: [.view, .patches, .states]
      case .completedStates: [.view, .completed]
      case .cloud: [.view, .completed, .completedStates]
      }
    }
  }

  /// What a file must match to be valid.
  struct Key: Hashable, Sendable {
    var step: Step
    var photo: ID<Photo>
    /// Pixels of the view.
    var width: Int
    var height: Int
    /// Of all inputs of the file.
    var fingerprint: UInt64
  }

  let folder: URL
  /// Keeps a temporary folder in existence.
  private let temporary: ScratchFolder?

  /// Whether the folder is removed when the workspace is no longer used.
  var isTemporary: Bool { temporary != nil }

  /// Opens or creates the folder; nil creates a temporary one in `temporaryParent`. Throws
  /// `WorkspaceError.notWritable`.
  init(folder: URL?, temporaryParent: URL = ScratchFolder.parent) throws {
    do {
      temporary = try folder == nil ? ScratchFolder(in: temporaryParent) : nil
      self.folder = folder ?? temporary?.url ?? temporaryParent
      try FileManager.default.createDirectory(at: self.folder, withIntermediateDirectories: true)
    } catch {
      throw WorkspaceError.notWritable(
        folder: (folder ?? temporaryParent).path, isTemporary: folder == nil)
    }
    UnfinishedFiles.remove(from: self.folder)
  }

  /// Throws `WorkspaceError.noSpace` if the disk has fewer than `needed` free bytes.
  func checkSpace(_ needed: Int) throws {
    let values = try? FileManager.default.attributesOfFileSystem(forPath: folder.path)
    guard let free = (values?[.systemFreeSize] as? NSNumber)?.intValue, free < needed else {
      return
    }
    throw WorkspaceError.noSpace(
      folder: folder.path, needed: needed, free: free, isTemporary: isTemporary)
  }

  /// Writes or replaces a view's file.
  func write(_ payload: UnsafeRawBufferPointer, _ key: Key) throws {
    let header = Header(key, payload)
    do {
      try withUnsafeBytes(of: header.words) { try AtomicFile.write([$0, payload], to: url(key)) }
    } catch OutputError.diskFull {
      throw WorkspaceError.noSpace(
        folder: folder.path, needed: payload.count, free: 0, isTemporary: isTemporary)
    } catch OutputError.notWritable {
      throw WorkspaceError.notWritable(folder: folder.path, isTemporary: isTemporary)
    }
  }

  /// Reads a file into `buffer`, which must have the exact payload size; false if the file is
  /// missing or invalid.
  func read(_ key: Key, into buffer: UnsafeMutableRawBufferPointer) -> Bool {
    guard let file = InputFile(url(key)), let header = Header(file), header.isFor(key),
      header.byteCount == buffer.count, file.byteCount == Header.byteCount + buffer.count,
      file.read(into: buffer)
    else { return false }
    return header == Header(key, UnsafeRawBufferPointer(buffer))
  }

  /// Reads a file of any size; nil if it is missing or invalid.
  func bytes(_ key: Key) -> [UInt8]? {
    guard let file = InputFile(url(key)), let header = Header(file), header.isFor(key),
      header.byteCount == file.byteCount - Header.byteCount
    else { return nil }
    var isComplete = false
    let bytes = [UInt8](unsafeUninitializedCapacity: header.byteCount) { buffer, count in
      isComplete = file.read(into: UnsafeMutableRawBufferPointer(buffer))
      count = isComplete ? header.byteCount : 0
    }
    guard isComplete else { return nil }
    return bytes.withUnsafeBytes { header == Header(key, $0) } ? bytes : nil
  }

  /// Whether a valid file exists; reads it in full to verify the checksum.
  func contains(_ key: Key) -> Bool { bytes(key) != nil }

  /// The path of a view's file: four-digit photo index and step name.
  func url(_ key: Key) -> URL {
    let number = String(key.photo.index)
    let padding = String(repeating: "0", count: max(0, 4 - number.count))
    return folder.appendingPathComponent("\(padding)\(number).\(key.step.rawValue)")
  }
}

extension PatchWorkspace {
  /// The header of a file.
  private struct Header: Equatable {
    /// "PATCHES1" in ASCII.
    private static let magic: UInt64 = 0x3153_4548_4354_4150
    static let byteCount = MemoryLayout<SIMD8<UInt64>>.size

    /// Magic number, step, fingerprint, width, height, payload size, payload checksum, 0.
    let words: SIMD8<UInt64>

    init(_ key: Key, _ payload: UnsafeRawBufferPointer) {
      var words = SIMD8<UInt64>(repeating: 0)
      words[0] = Self.magic
      words[1] = Self.number(of: key.step)
      words[2] = key.fingerprint
      words[3] = UInt64(key.width)
      words[4] = UInt64(key.height)
      words[5] = UInt64(payload.count)
      words[6] = XXHash64.hash(payload, seed: key.fingerprint)
      self.words = words
    }

    /// Nil if the file has no valid header.
    init?(_ file: borrowing InputFile) {
      var words = SIMD8<UInt64>(repeating: 0)
      guard withUnsafeMutableBytes(of: &words, { file.read(into: $0) }), words[0] == Self.magic,
        words[5] <= UInt64(Int.max / 2)
      else { return nil }
      self.words = words
    }

    var byteCount: Int { Int(words[5]) }

    /// Whether the file has the step, fingerprint and size of `key`.
    func isFor(_ key: Key) -> Bool {
      words[1] == Self.number(of: key.step) && words[2] == key.fingerprint
        && words[3] == UInt64(key.width) && words[4] == UInt64(key.height)
    }

    private static func number(of step: Step) -> UInt64 {
      UInt64(Step.allCases.firstIndex(of: step) ?? 0)
    }
  }
}
