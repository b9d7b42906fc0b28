import Foundation
import Formats
import Kernels
import SceneModel
import TestSupport

// Writes the photo sets in Fixtures/ anew: `swift run -c release render-fixtures Fixtures`.
// The same program gives the same bytes. `render-fixtures <folder> faint` writes a set of low texture
// instead, to compare sensitivities on.

let folder = URL(
  fileURLWithPath: CommandLine.arguments.dropFirst().first ?? "Fixtures", isDirectory: true)
let control = KernelControl(threadCount: 2)

var exif = ExifFields()
exif.make = "Rendered"
exif.model = "Pinhole"

let statue = RenderedScene.statue()
// On a full-frame sensor, 36 mm wide.
let tenths = UInt32((statue.camera.focalLength.x / Double(statue.camera.width) * 360).rounded())
exif.focalLength = (tenths, 10)
exif.focalLengthIn35mmFilm = Int((Double(tenths) / 10).rounded())
if CommandLine.arguments.dropFirst(2).first == "faint" {
  try PhotoSet(scene: .faintStatue(), exif: exif, quality: 0.92)
    .write(to: folder.appendingPathComponent("faint", isDirectory: true), control)
  exit(0)
}

let statueSet = PhotoSet(scene: statue, exif: exif, quality: 0.82)
try statueSet.write(to: folder.appendingPathComponent("orbit", isDirectory: true), control)

let relief = RenderedScene.relief()
try PhotoSet(scene: relief, exif: nil, quality: 0.85)
  .write(to: folder.appendingPathComponent("relief", isDirectory: true), control)

try BadPhotos(scene: .statue(photoCount: 2, upperCount: 0, width: 480, height: 360))
  .write(to: folder.appendingPathComponent("bad", isDirectory: true), control)
