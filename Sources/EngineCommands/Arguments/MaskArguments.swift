import ArgumentParser
import Foundation
import SharedCommands

/// The folder of the photos' masks.
struct MaskArguments: ParsableArguments {
  /// What masks are and where they are found, as a section of help.
  static let help = """
    MASKS
      A mask is black where its photo does not show the object. Black pixels are
      ignored in alignment, so that an object may turn in front of a fixed camera,
      and in the surface and its colors. The mask of the photo IMG_1.jpg is
          IMG_1_mask.png, IMG_1.mask.png or IMG_1.jpg.mask.png next to the photo;
          one of these, IMG_1.png or IMG_1.jpg.png in the folder masks/ next to
          the photo, or in that of --masks;
          or the alpha channel of the photo, in PNG, TIFF or WebP.
      Masks of another size are scaled. A photo without a mask is used in full.
      If masks leave too few features to align the photos, features of the
      background are used as well, provided that the object did not move.

    OBJECTS THAT MOVE
      An object may turn on a turntable or by hand, or be laid on another side once
      or several times to show its underside; take at least five photos of each
      side, in order. Without masks, what moves is separated from what stands still,
      and all sides are joined in one model. Neighboring photos still have to
      overlap, and after a change of side some photos must show the same parts of
      the object as before.

    """

  @Option(
    name: .long,
    help: ArgumentHelp(
      "The folder with the photos' masks. (default: masks/ in the photos' folder)",
      valueName: "folder"), completion: .directory)
  var masks: String?

  /// The folder; nil if none is named. Throws a `CommandFailure` if it can't be read or is empty.
  var folder: URL? {
    get throws { try masks.map { try PhotoFolderArgument($0, holding: "masks").url } }
  }
}
