import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct EstimatedMasksTests {
  private let temporary: TemporaryFolder
  private let photos = (0..<3).map { index in
    Photo(
      id: ID(index), sampleID: index, name: "\(index).jpg",
      url: URL(fileURLWithPath: "/\(index).jpg"), width: 4, height: 3, orientation: 1,
      camera: ID(0))
  }

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url.appendingPathComponent("masks") }
  private var files: [String] {
    ((try? FileManager.default.contentsOfDirectory(atPath: folder.path)) ?? []).sorted()
  }

  /// A result with masks of these photos.
  private func result(_ masked: [Int]) -> ObjectMasking.Result {
    var result = ObjectMasking.Result(photoCount: photos.count)
    for index in masked {
      result.masks[index] = RasterImage(width: 4, height: 3, channels: 1, filledWith: 255)
    }
    return result
  }

  @Test func masksOfAnEarlierAttemptAreRemoved() throws {
    #expect(
      try !EstimatedMasks(result([0, 1, 2]), of: photos, in: folder, KernelControl()).isEmpty)
    #expect(files.count == 3)
    let masks = try EstimatedMasks(result([0, 2]), of: photos, in: folder, KernelControl())
    #expect(files == masks.masks.compactMap { $0?.file?.lastPathComponent })
    #expect(masks.masks[1] == nil && masks.areIntact)
    #expect(try EstimatedMasks(nil, of: photos, in: folder, KernelControl()).isEmpty)
    #expect(files.isEmpty)
  }

  @Test func filesOfOthersStay() throws {
    try temporary.write("a note", as: "masks/note.txt")
    _ = try EstimatedMasks(result([0]), of: photos, in: folder, KernelControl())
    _ = try EstimatedMasks(nil, of: photos, in: folder, KernelControl())
    #expect(files == ["note.txt"])
  }
}
