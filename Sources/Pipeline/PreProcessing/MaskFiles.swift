import Formats
import Foundation

/// Separates the masks of an input folder from its photos, by file name, and finds the mask of a
/// photo.
///
/// In the photo's folder, the mask of `IMG_1.jpg` is named `IMG_1_mask.png` (Metashape),
/// `IMG_1.mask.png` or `IMG_1.jpg.mask.png` (RealityCapture). In a folder of masks it may have one
/// of these names, the photo's name (`IMG_1.png`), or the photo's name with a second extension
/// (`IMG_1.jpg.png`, COLMAP). Any image format is accepted; names are case-insensitive.
struct MaskFiles {
  /// The files that are not masks, in their original order.
  private(set) var photos: [URL] = []
  /// Masks without a photo.
  private(set) var masksWithoutPhoto: [URL] = []
  /// The masks by the lowercase file name or stem of their photo.
  private var masks: [String: URL] = [:]

  /// `files` are those of the folder of photos, `maskFiles` those of a folder of masks, which take
  /// precedence.
  init(files: [URL], maskFiles: [URL]) {
    let names = Set(files.flatMap(Self.names))
    for file in maskFiles {
      guard let owner = Self.ownerInMaskFolder(file) else { continue }
      if !names.contains(owner) {
        masksWithoutPhoto.append(file)
      } else if masks[owner] == nil {
        masks[owner] = file
      }
    }
    separate(files, names)
  }

  /// The mask of a photo; nil without one.
  func mask(of photo: URL) -> URL? { Self.names(of: photo).lazy.compactMap { masks[$0] }.first }

  /// Removes masks that are stored next to their photos from `files`. If there are any, files that
  /// are named like masks of missing photos don't count as photos either.
  private mutating func separate(_ files: [URL], _ names: Set<String>) {
    let owners = files.map(Self.ownerInPhotoFolder)
    let isMask = owners.map { owner in owner.map { names.contains($0) } ?? false }
    for index in files.indices {
      if isMask[index], let owner = owners[index] {
        if masks[owner] == nil { masks[owner] = files[index] }
      } else if owners[index] != nil, isMask.contains(true) {
        masksWithoutPhoto.append(files[index])
      } else {
        photos.append(files[index])
      }
    }
  }

  /// The lowercase file name with and without extension.
  private static func names(of file: URL) -> [String] {
    let name = file.lastPathComponent.lowercased()
    return [name, (name as NSString).deletingPathExtension]
  }

  /// The name of the photo that a file in the same folder is the mask of; nil if it isn't named
  /// like a mask.
  private static func ownerInPhotoFolder(_ file: URL) -> String? {
    guard isImageName(file) else { return nil }
    let stem = names(of: file)[1]
    for ending in ["_mask", ".mask"] where stem.hasSuffix(ending) && stem.count > ending.count {
      return String(stem.dropLast(ending.count))
    }
    return nil
  }

  /// The name of the photo that a file in a folder of masks is the mask of; nil for other files.
  private static func ownerInMaskFolder(_ file: URL) -> String? {
    isImageName(file) ? ownerInPhotoFolder(file) ?? names(of: file)[1] : nil
  }

  private static func isImageName(_ file: URL) -> Bool {
    ["png", "jpg", "jpeg", "tif", "tiff", "webp", "bmp", "heic"]
      .contains(file.pathExtension.lowercased())
  }
}

extension MaskFiles {
  /// File names for the masks of photos: `IMG_1.png` for `IMG_1.jpg`, or `IMG_1.jpg.png` if another
  /// photo is named `IMG_1`, too.
  static func names(forMasksOf photos: [String]) -> [String] {
    let stems = photos.map { ($0 as NSString).deletingPathExtension }
    var counts: [String: Int] = [:]
    for stem in stems { counts[stem.lowercased(), default: 0] += 1 }
    return zip(photos, stems).map { name, stem in
      (counts[stem.lowercased()] == 1 ? stem : name) + ".png"
    }
  }

  /// Classifies the files of `folder`. Masks come from `maskFolder`, or from a mask folder inside
  /// `folder` if it is nil.
  init(folder: URL, maskFolder: URL?) throws {
    let files = try PhotoFolder.files(in: folder)
    let named = maskFolder.map { [$0] }
    let inner = PhotoFolder.maskFolderNames.map {
      folder.appendingPathComponent($0, isDirectory: true)
    }
    let source = (named ?? inner.filter(\.isExistingFolder)).first
    // In the folder of photos itself, every photo would be its own mask.
    let isSeparateFolder =
      source?.resolvingSymlinksInPath().standardizedFileURL.path
      != folder.resolvingSymlinksInPath().standardizedFileURL.path
    let maskFiles = try isSeparateFolder ? source.map(PhotoFolder.files) ?? [] : []
    self.init(files: files, maskFiles: maskFiles)
  }
}
