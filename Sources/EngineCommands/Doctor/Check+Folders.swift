import Pipeline
import SharedCommands

extension Check {
  /// A set of usual size, to which the space is compared. Chosen: in the middle of the 20 to 200
  /// photos that are recommended.
  private static let usualPhotos = 100
  /// The smallest set that is recommended. Chosen: as in docs/taking-photos.md.
  private static let fewPhotos = 20

  /// The space for intermediate results, which a run removes at its end.
  static func temporaryFolder(_ folder: FolderState) -> Check {
    let choice = "Set TMPDIR to a folder on a disk with more space: export TMPDIR=<folder>"
    guard folder.isWritable else {
      return Check(
        .temporaryFolder, .problem, "\(folder.path) can't be written to.",
        remedy: "Set TMPDIR to a folder that can: export TMPDIR=<folder>")
    }
    guard let free = folder.freeBytes else {
      return Check(.temporaryFolder, .ok, "\(folder.path) can be written to.")
    }
    let found = "\(folder.path) has \(gigabytes(free)) free"
    let fitting = DetailArgument.allCases.filter { workspaceBytes($0, usualPhotos) <= free }
    guard workspaceBytes(.preview, fewPhotos) <= free else {
      return Check(.temporaryFolder, .problem, "\(found), which is not enough.", remedy: choice)
    }
    if folder.isInMemory {
      return Check(
        .temporaryFolder, .note, "\(found), but it is in memory: files there leave less for a run.",
        remedy: "Set TMPDIR to a folder on a disk: export TMPDIR=/var/tmp")
    }
    if fitting.contains(.medium) {
      return Check(
        .temporaryFolder, .ok,
        "\(found): enough for \(levels(upTo: fitting.last)) with \(usualPhotos) photos.")
    }
    let needed = gigabytes(workspaceBytes(.medium, usualPhotos))
    return Check(
      .temporaryFolder, .note,
      "\(found); '-d medium' with \(usualPhotos) photos needs about \(needed).", remedy: choice)
  }

  /// The folder in which models are written that are named without a folder.
  static func currentFolder(_ folder: FolderState) -> Check {
    guard folder.isWritable else {
      return Check(
        .currentFolder, .note, "\(folder.path) can't be written to.",
        remedy: "Name the model with a folder that can, for instance ~/model.usdz.")
    }
    guard let free = folder.freeBytes else {
      return Check(.currentFolder, .ok, "\(folder.path) can be written to.")
    }
    let found = "\(folder.path) can be written to and has \(gigabytes(free)) free"
    let needed = DetailArgument.reduced.limits.modelBytes(in: .usdz)
    return free >= needed
      ? Check(.currentFolder, .ok, "\(found).")
      : Check(
        .currentFolder, .note, "\(found); a model may take \(needed / 1_000_000) MB.",
        remedy: "Free some space, or name the model with a folder on another disk.")
  }

  private static func workspaceBytes(_ level: DetailArgument, _ photos: Int) -> Int {
    level.limits.workspaceBytesPerPhoto * photos
  }
}
