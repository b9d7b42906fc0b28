import Foundation
import TestSupport
import Testing
import UniformTypeIdentifiers

@Suite struct UTTypeTests {
  @Test(
    arguments: [
      ("jpg", UTType.jpeg), ("JPEG", .jpeg), ("jpe", .jpeg), ("png", .png), ("tif", .tiff),
      ("tiff", .tiff), ("heic", .heic), ("heif", .heif), ("hif", .heif), ("gif", .gif),
      ("bmp", .bmp), ("webp", .webP), ("exr", .exr), ("dng", .dng), ("usd", .usd), ("usda", .usd),
      ("usdc", .usd), ("usdz", .usdz), ("reality", .realityFile), ("mp4", .mpeg4Movie),
      ("mov", .quickTimeMovie), ("txt", .plainText), ("json", .json), ("csv", .commaSeparatedText),
      ("xml", .xml), ("pdf", .pdf), ("zip", .zip),
    ] as [(String, UTType)]) func suffixesHaveTheirType(suffix: String, type: UTType)
  {
    #expect(UTType(filenameExtension: suffix) == type)
  }

  @Test(
    arguments: [
      ("image/jpeg", UTType.jpeg), ("IMAGE/PNG", .png), ("image/heic", .heic),
      ("model/vnd.usdz+zip", .usdz), ("video/quicktime", .quickTimeMovie),
      ("application/json", .json), ("text/plain", .plainText),
    ] as [(String, UTType)]) func mimeTypesHaveTheirType(name: String, type: UTType)
  {
    #expect(UTType(mimeType: name) == type)
    #expect(type.preferredMIMEType == name.lowercased())
  }

  @Test func unknownNamesGiveNone() {
    #expect(UTType(filenameExtension: "unknown") == nil && UTType(filenameExtension: "") == nil)
    #expect(UTType(mimeType: "image/unknown") == nil && UTType("com.example.unknown") == nil)
    #expect(UTType("public.jpeg") == .jpeg)
  }

  @Test func supertypesRestrictTheSearch() {
    #expect(UTType(filenameExtension: "jpg", conformingTo: .image) == .jpeg)
    #expect(UTType(filenameExtension: "jpg", conformingTo: .movie) == nil)
    #expect(UTType(mimeType: "image/png", conformingTo: .image) == .png)
    #expect(UTType(mimeType: "image/png", conformingTo: .text) == nil)
    #expect(UTType(filenameExtension: "ply", conformingTo: .threeDContent) != nil)
  }

  @Test func preferredSuffixesAreTheUsualOnes() {
    #expect(UTType.jpeg.preferredFilenameExtension == "jpeg")
    #expect(UTType.tiff.preferredFilenameExtension == "tiff")
    #expect(UTType.quickTimeMovie.preferredFilenameExtension == "mov")
    #expect(UTType.image.preferredFilenameExtension == nil && UTType.image.preferredMIMEType == nil)
  }

  @Test func conformanceIsTransitive() {
    #expect(UTType.heic.supertypes == [.heif, .image, .data, .content, .item])
    for type in [UTType.jpeg, .png, .tiff, .heic, .dng, .webP] {
      #expect(type.conforms(to: .image) && type.conforms(to: .data) && type.conforms(to: .item))
      #expect(!type.conforms(to: .movie) && !type.conforms(to: .directory))
    }
    #expect(UTType.usdz.conforms(to: .threeDContent) && !UTType.usdz.conforms(to: .usd))
    #expect(UTType.folder.conforms(to: .directory) && !UTType.folder.conforms(to: .data))
    #expect(UTType.mpeg4Movie.conforms(to: .audiovisualContent))
  }

  @Test func aTypeConformsToItselfWithoutBeingASubtype() {
    #expect(UTType.jpeg.conforms(to: .jpeg) && !UTType.jpeg.isSubtype(of: .jpeg))
    #expect(UTType.jpeg.isSubtype(of: .image) && !UTType.image.isSubtype(of: .jpeg))
    #expect(UTType.image.isSupertype(of: .jpeg) && !UTType.jpeg.isSupertype(of: .image))
  }

  @Test func identifiersAreApples() throws {
    #expect(UTType.jpeg.identifier == "public.jpeg" && "\(UTType.jpeg)" == "public.jpeg")
    #expect(UTType.usdz.identifier == "com.pixar.universal-scene-description-mobile")
    #expect(UTType.rawImage.identifier == "public.camera-raw-image")
    let data = try JSONEncoder().encode([UTType.png])
    #expect(try JSONDecoder().decode([UTType].self, from: data) == [.png])
  }

  @Test func urlsGetASuffix() {
    let folder = URL(fileURLWithPath: "/models", isDirectory: true)
    #expect(folder.appendingPathComponent("a", conformingTo: .usdz).path == "/models/a.usdz")
    #expect(folder.appendingPathComponent("a.usd", conformingTo: .usdz).path == "/models/a.usd")
    #expect(folder.appendingPathComponent("a", conformingTo: .folder).hasDirectoryPath)
    #expect(folder.appendingPathComponent("a", conformingTo: .image).path == "/models/a")
    let file = URL(fileURLWithPath: "/models/b")
    #expect(file.appendingPathExtension(for: .jpeg).lastPathComponent == "b.jpeg")
    #expect(file.appendingPathExtension(for: .data).lastPathComponent == "b")
  }

  @Test func resourceValuesHaveATypeBySuffix() throws {
    let folder = try TemporaryFolder()
    func type(_ url: URL, _ keys: Set<URLResourceKey>) throws -> UTType? {
      try url.resourceValues(forKeys: keys).contentType
    }
    let file = try folder.write([1], as: "photo.HEIC")
    #expect(try type(file, [.contentTypeKey]) == .heic)
    #expect(try type(folder.url, [.contentTypeKey, .isDirectoryKey]) == .folder)
    #expect(try type(try folder.write([1], as: "unknown"), [.contentTypeKey]) == nil)
  }
}
