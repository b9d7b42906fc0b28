import Foundation
import ImageFiles
import Kernels
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct DemoPhotosTests {
  @Test func photosDoNotDependOnThreads() throws {
    let scene = DemoPhotos().scene
    #expect(try scene.photo(7, KernelControl()) == scene.photo(7, KernelControl(threadCount: 3)))
  }

  @Test func cancellationLeavesWholePhotosOnly() throws {
    let temporary = try TemporaryFolder()
    let flag = CancellationFlag()
    let control = KernelControl(threadCount: 2, flag: flag) { if $0 > 0.07 { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try DemoPhotos().write(to: temporary.url, control)
    }
    let names = try FileManager.default.contentsOfDirectory(atPath: temporary.url.path)
    #expect(names == ["demo_00.jpg"])
    let bytes = try ImageCodec.contents(of: temporary.url.appendingPathComponent(names[0]))
    let photo = try ImageCodec.decode(bytes)
    #expect(photo.width == 800 && photo.height == 600)
    #expect(PhotoMetadata(bytes).focalLengthIn35mmFilm == 41)
  }
}
