import Foundation
import Kernels
import TestSupport

// Regenerates the photo sets in Fixtures/: `swift run -c release render-fixtures Fixtures`.
// The output is deterministic. Other sets, for benchmarks:
//
//   render-fixtures <folder> faint             a low-texture set, to compare sensitivities
//   render-fixtures <folder> dense [name …]    sets to evaluate the dense stage, by name or all
//   render-fixtures <folder> texture [name …]  sets to evaluate the texture, with held-out photos
//   render-fixtures <folder> ring [count]      a large set of photos, 160 by default
//   render-fixtures <folder> captures [seed] [object,…|all] [capture,…|all] [surroundings,…|all]
//   render-fixtures <folder> twins [seed] [name,…|all] [width]
//   render-fixtures <folder> town [count] [seed] [width]
//   render-fixtures <folder> loudspeaker [seed] [still|hand]
//   render-fixtures <folder> wallpaper [seed]
//   render-fixtures <folder> video [seed] [frames]
//
// `captures` writes a set `<object>-<capture>-<surroundings>` per combination, with exact masks, to
// compare kinds of capture: the seed is 1 by default; the other names are the cases of
// `CaptureObject`, `Capture` and `CaptureSurroundings`. Cameras and surface are in the frame of the
// object, in which the cameras of all captures are comparable.
//
// `twins` writes sets `<name>-<seed>` of 80 to 200 photos, of the kinds in a publication: the names
// are the cases of `TwinObject`. Each seed gives another object, surroundings and walk of the same
// kind; it is 1 by default, and photos are 1000 pixels wide. Every fifth photo is held out: it is
// in `holdout`, with its mask beside it, instead of in `images`; `gt/cameras.json` marks it. The
// photos of `toy-car` are one continuous walk, those of the others several rings.
//
// `town` writes `town-<count>-<seed>`: that number of photos, 100 by default, of a town that a car
// drives through, with GPS positions that are wrong by some meters. The town grows with the number.
//
// `loudspeaker` writes sets `loudspeaker-<motion>-<seed>` in the same format: a black object with
// hardly any texture on a wooden table, whose grain connects the photos although the object is
// turned; both motions by default. `wallpaper` writes `wallpaper-<seed>`: frames of a video of an
// object in front of a flower that repeats on a lattice.
//
// `video` writes `video-<seed>`: a video of 30 s, encoded with the program ffmpeg, with motion blur
// and rolling shutter, of a walk around the statue of the dense stage. With the folder that
// `photogrammetry-cli frames` made of it, it writes the same frames as photos instead, with and
// without blur and rolling shutter.
//
// The sets for the dense stage have their surface and cameras in a z-up frame; the table, at z = 0,
// is not part of the surface. Those of captures and twins are z-up as
// well.

let target = CommandLine.arguments.dropFirst().first ?? "Fixtures"
guard !target.hasPrefix("-") else {
  FileHandle.standardError.write(
    Data("render-fixtures: '\(target)' is no folder; see Tests/FixtureRenderer/main.swift\n".utf8))
  exit(2)
}
let folder = URL(fileURLWithPath: target, isDirectory: true)
let words = Array(CommandLine.arguments.dropFirst(2))
let control = KernelControl(threadCount: ProcessInfo.processInfo.activeProcessorCount)

switch words.first {
case "faint":
  try write(PhotoSet(scene: .faintStatue(), quality: 0.92), "faint")
case "dense":
  for scene in DenseScene.allCases where words.count == 1 || words.contains(scene.rawValue) {
    try write(PhotoSet(scene: scene.scene(), quality: 0.92, isZUp: true), scene.rawValue)
  }
case "texture":
  for scene in TextureScene.allCases where words.count == 1 || words.contains(scene.rawValue) {
    try write(
      PhotoSet(scene: scene.scene(), quality: 0.92, isZUp: true, held: TextureScene.held()),
      "texture-\(scene.rawValue)")
  }
case "ring":
  let count = words.dropFirst().first.flatMap { Int($0) } ?? 160
  let scene = DenseScene.rich.scene(
    width: 816, poses: DenseScene.sweep(count: count), fineness: 0.5)
  try write(PhotoSet(scene: scene, quality: 0.92, isZUp: true), "ring")
case "captures":
  try CaptureSelection(Array(words.dropFirst())).forEach { scene, name in
    try write(scene, name)
  }
case "twins":
  try TwinSelection(Array(words.dropFirst())).forEach(control) { twin, name in
    try TwinSet(twin: twin).write(
      to: folder.appendingPathComponent(name, isDirectory: true), control)
  }
case "town":
  let count = words.dropFirst().first.flatMap { Int($0) } ?? 100
  let seed = try CaptureSelection.seed(words.dropFirst(2).first)
  let width = words.dropFirst(3).first.flatMap { Int($0) } ?? 1200
  try TownSet(town: TownScene(photoCount: count, seed: seed, width: width)).write(
    to: folder.appendingPathComponent("town-\(count)-\(seed)", isDirectory: true), control)
case "loudspeaker":
  let seed = try CaptureSelection.seed(words.dropFirst().first)
  for motion in try CaptureSelection.cases(words.dropFirst(2).first, of: LoudspeakerMotion.self) {
    try write(.loudspeaker(motion, seed: seed), "loudspeaker-\(motion.rawValue)-\(seed)")
  }
case "wallpaper":
  let seed = try CaptureSelection.seed(words.dropFirst().first)
  try write(.wallpaper(seed: seed), "wallpaper-\(seed)")
case "video":
  let seed = try CaptureSelection.seed(words.dropFirst().first)
  let set = VideoSet(video: WalkAroundVideo(seed: seed))
  let target = folder.appendingPathComponent("video-\(seed)", isDirectory: true)
  if let frames = words.dropFirst(2).first {
    try set.writePhotos(of: URL(fileURLWithPath: frames, isDirectory: true), to: target, control)
  } else {
    try set.write(to: target, control)
  }
default:
  try write(PhotoSet(scene: .statue(), quality: 0.82), "orbit")
  try write(PhotoSet(scene: .relief(), hasMetadata: false, quality: 0.85), "relief")
  try BadPhotos(scene: .statue(photoCount: 2, upperCount: 0, width: 480, height: 360))
    .write(to: folder.appendingPathComponent("bad", isDirectory: true), control)
}

func write(_ set: PhotoSet, _ name: String) throws {
  try set.write(to: folder.appendingPathComponent(name, isDirectory: true), control)
}

func write(_ scene: CaptureScene, _ name: String) throws {
  try CaptureSet(scene: scene)
    .write(to: folder.appendingPathComponent(name, isDirectory: true), control)
}
