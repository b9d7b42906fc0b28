import Foundation
import Kernels

/// The photos of a folder as one process found them, for others that work on the same run.
struct IngestedRecord: Codable, UnitValue {
  var ingested: IngestedPhotos
  private var notes: SavedNotes

  init(_ ingested: IngestedPhotos, _ notes: StageNotes) {
    (self.ingested, self.notes) = (ingested, SavedNotes(notes))
  }

  /// Records the notes of the stage again.
  func replayNotes(to notes: StageNotes) { self.notes.replay(to: notes) }

  /// A number that changes with the files of a folder and of its masks, and with the options.
  ///
  /// Files are identified by name, size and time of modification, since every process of a run
  /// would have to read all of them otherwise.
  static func key(of folder: URL, _ options: PhotoIngestion.Options) throws -> UInt64 {
    var key = Fingerprint()
    key.add(try Fingerprint.content(of: options))
    let masks =
      options.maskFolder.map { [$0] }
      ?? PhotoFolder.maskFolderNames.map { folder.appendingPathComponent($0) }
    let files =
      try PhotoFolder.files(in: folder)
      + masks.flatMap { masks in
        (try? PhotoFolder.files(in: masks)) ?? []
      }
    // Their URLs are part of the result.
    key.add(folder.path.utf8)
    for file in files { key.addAttributes(of: file) }
    return key.value
  }
}
