import Foundation

/// Tells the masks of an input folder from its photos, by their names, and finds the mask of a photo.
///
/// Beside a photo `IMG_1.jpg` its mask is called `IMG_1_mask.png`, as Metashape writes it,
/// `IMG_1.mask.png` or, as RealityCapture has it, `IMG_1.jpg.mask.png`. In a folder of masks it may
/// have one of these names, the photo's own (`IMG_1.png`), or the photo's with a second suffix, as
/// COLMAP wants it (`IMG_1.jpg.png`). Any image format will do, and upper and lower case are alike.
struct MaskFiles {
  /// Folders of masks that are looked for inside the folder of photos.
  static let folderNames = ["masks", "mask", ".mask"]

  /// The files that are no masks, in their order.
  private(set) var photos: [URL] = []
  /// Masks without a photo.
  private(set) var strays: [URL] = []
  /// The masks by the name, without suffix, of what they belong to.
  private var masks: [String: URL] = [:]

  /// `files` are those of the folder of photos, `maskFiles` those of a folder of masks, which come
  /// first.
  init(files: [URL], maskFiles: [URL]) {
    let names = Set(files.flatMap(Self.names))
    for file in maskFiles {
      guard let owner = Self.ownerInMaskFolder(file) else { continue }
      if !names.contains(owner) {
        strays.append(file)
      } else if masks[owner] == nil {
        masks[owner] = file
      }
    }
    separate(files, names)
  }

  /// The mask of a photo; nil without one.
  func mask(of photo: URL) -> URL? { Self.names(of: photo).lazy.compactMap { masks[$0] }.first }

  /// Puts masks that lie beside their photos aside. Where there are such, files that are called like
  /// masks of photos that aren't there are none either.
  private mutating func separate(_ files: [URL], _ names: Set<String>) {
    let owners = files.map(Self.ownerBeside)
    let isMask = owners.map { owner in owner.map { names.contains($0) } ?? false }
    for index in files.indices {
      if isMask[index], let owner = owners[index] {
        if masks[owner] == nil { masks[owner] = files[index] }
      } else if owners[index] != nil, isMask.contains(true) {
        strays.append(files[index])
      } else {
        photos.append(files[index])
      }
    }
  }

  /// The whole name and the name without suffix.
  private static func names(of file: URL) -> [String] {
    let name = file.lastPathComponent.lowercased()
    return [name, (name as NSString).deletingPathExtension]
  }

  /// What a file beside the photos is the mask of; nil where it isn't called like a mask.
  private static func ownerBeside(_ file: URL) -> String? {
    guard isImageName(file) else { return nil }
    let stem = names(of: file)[1]
    for ending in ["_mask", ".mask"] where stem.hasSuffix(ending) && stem.count > ending.count {
      return String(stem.dropLast(ending.count))
    }
    return nil
  }

  private static func ownerInMaskFolder(_ file: URL) -> String? {
    isImageName(file) ? ownerBeside(file) ?? names(of: file)[1] : nil
  }

  private static func isImageName(_ file: URL) -> Bool {
    ["png", "jpg", "jpeg", "tif", "tiff", "webp", "bmp", "heic"]
      .contains(file.pathExtension.lowercased())
  }
}

extension MaskFiles {
  /// The files of `folder`, told apart; masks come from `maskFolder`, or from a folder inside of it
  /// where none is named.
  init(folder: URL, maskFolder: URL?) throws {
    let files = try PhotoFolder.files(in: folder)
    let named = maskFolder.map { [$0] }
    let inner = Self.folderNames.map { folder.appendingPathComponent($0, isDirectory: true) }
    let source = (named ?? inner.filter(Self.isFolder)).first
    // In the folder of photos itself every photo would be its own mask.
    let isElsewhere =
      source?.resolvingSymlinksInPath().standardizedFileURL.path
      != folder.resolvingSymlinksInPath().standardizedFileURL.path
    let maskFiles = try isElsewhere ? source.map(PhotoFolder.files) ?? [] : []
    self.init(files: files, maskFiles: maskFiles)
  }

  private static func isFolder(_ url: URL) -> Bool {
    var isDirectory: ObjCBool = false
    return FileManager.default.fileExists(atPath: url.path, isDirectory: &isDirectory)
      && isDirectory.boolValue
  }
}
