import Foundation
import UniformTypeIdentifiers

/// Uses the uniform types.
func useContentTypes() {
  let images: [UTType] = [
    .jpeg, .png, .tiff, .heic, .heif, .gif, .bmp, .webP, .exr, .rawImage, .dng,
  ]
  check(images.allSatisfy { $0.conforms(to: .image) && $0.isSubtype(of: .data) }, "images")
  let models: [UTType] = [.usd, .usdz, .realityFile]
  check(models.allSatisfy { UTType.threeDContent.isSupertype(of: $0) }, "models")
  let videos: [UTType] = [.movie, .video, .mpeg4Movie, .quickTimeMovie]
  check(videos.allSatisfy { $0.conforms(to: .audiovisualContent) }, "videos")
  let texts: [UTType] = [.plainText, .json, .commaSeparatedText, .xml]
  check(texts.allSatisfy { $0.conforms(to: .text) && $0.conforms(to: .content) }, "texts")
  check(UTType.zip.conforms(to: .archive) && UTType.pdf.supertypes.contains(.item), "others")
  check(UTType.folder.conforms(to: .directory) && UTType.package != .folder, "folders")
  check(
    UTType(filenameExtension: "JPG") == .jpeg && UTType(filenameExtension: "x") == nil, "extension")
  check(UTType(filenameExtension: "usdz", conformingTo: .image) == nil, "no image")
  check(UTType(mimeType: "image/png") == .png && UTType("public.jpeg") == .jpeg, "names")
  check(UTType.usdz.preferredFilenameExtension == "usdz", "the preferred extension")
  check(
    UTType.jpeg.preferredMIMEType == "image/jpeg" && "\(UTType.png)" == UTType.png.identifier, "")
  let folder = URL(fileURLWithPath: "/tmp", isDirectory: true)
  check(
    folder.appendingPathComponent("a", conformingTo: .usdz).lastPathComponent == "a.usdz", "URL")
  check(folder.appendingPathExtension(for: .png).pathExtension == "png", "an appended extension")
  check(folder.startAccessingSecurityScopedResource(), "there is no sandbox")
  folder.stopAccessingSecurityScopedResource()
}
