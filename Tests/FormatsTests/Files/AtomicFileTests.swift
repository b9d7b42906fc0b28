import Foundation
import TestFiles
import Testing

@testable import Formats

@Suite struct AtomicFileTests {
  @Test func replacesAndLeavesNothingElse() throws {
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("a.bin")
      try AtomicFile.write([1, 2, 3], to: url)
      try AtomicFile.write([4], to: url)
      #expect([UInt8](try Data(contentsOf: url)) == [4])
      #expect(try FileManager.default.contentsOfDirectory(atPath: folder.path) == ["a.bin"])
    }
  }

  @Test func staleTemporaryFilesAreRemoved() throws {
    try withTemporaryFolder { folder in
      let model = AtomicFile.temporaryURL(for: folder.appendingPathComponent("a.usdz"))
      let other = AtomicFile.temporaryURL(for: folder.appendingPathComponent("b.usdz"))
      let young = AtomicFile.temporaryURL(for: folder.appendingPathComponent("a.usdz"))
      for url in [model, other, young] { try Data([1]).write(to: url) }
      for url in [model, other] {
        try FileManager.default.setAttributes(
          [.modificationDate: Date(timeIntervalSinceNow: -UnfinishedFiles.minimumAge - 60)],
          ofItemAtPath: url.path)
      }
      func left() throws -> Set<String> {
        Set(try FileManager.default.contentsOfDirectory(atPath: folder.path))
      }
      UnfinishedFiles.remove(from: folder, of: "a.usdz")
      #expect(try left() == [other.lastPathComponent, young.lastPathComponent])
      UnfinishedFiles.remove(from: folder)
      #expect(try left() == [young.lastPathComponent])
    }
  }

  /// The temporary name must not exceed the file system's limit if the name itself doesn't.
  @Test(arguments: ["n", "é", "模"])
  func longestFileNamesAreWritten(_ letter: String) throws {
    try withTemporaryFolder { folder in
      let name = String(repeating: letter, count: 255 / letter.utf8.count)
      try AtomicFile.write([1], to: folder.appendingPathComponent(name))
      #expect(try FileManager.default.contentsOfDirectory(atPath: folder.path) == [name])
    }
  }

  @Test func missingParentFolderIsReportedWithRemedy() throws {
    try withTemporaryFolder { folder in
      let missing = folder.appendingPathComponent("no/such", isDirectory: true)
      let error = #expect(throws: OutputError.self) {
        try AtomicFile.write([1], to: missing.appendingPathComponent("x.usdz"))
      }
      #expect(error?.errorDescription?.contains("x.usdz") == true)
      #expect(error?.recoverySuggestion?.contains("mkdir -p") == true)
      #expect(!FileManager.default.fileExists(atPath: missing.path))
    }
  }

  @Test func existingFolderIsAnError() throws {
    try withTemporaryFolder { (folder: URL) -> Void in
      #expect(throws: OutputError.isAFolder(path: folder.path)) {
        try AtomicFile.write([1], to: folder)
      }
    }
  }

  @Test func existingFileIsAnErrorForFolders() throws {
    try withTemporaryFolder { folder in
      let file = folder.appendingPathComponent("f")
      try AtomicFile.write([1], to: file)
      #expect(throws: OutputError.notAFolder(path: file.path)) {
        try AtomicDirectory.write(to: file) { _ in }
      }
      #expect(throws: OutputError.notAFolder(path: file.path)) {
        try AtomicFile.write([1], to: file.appendingPathComponent("g"))
      }
    }
  }

  @Test func fullDiskIsReported() throws {
    let error = AtomicFile.outputError(POSIXError(.ENOSPC), path: "/x/y")
    #expect(error as? OutputError == .diskFull(path: "/x/y"))
    let cocoa = AtomicFile.outputError(CocoaError(.fileWriteOutOfSpace), path: "/x/y")
    #expect(cocoa as? OutputError == .diskFull(path: "/x/y"))
    let denied = AtomicFile.outputError(CocoaError(.fileWriteNoPermission), path: "/x/y")
    #expect(denied as? OutputError == .notWritable(path: "/x/y"))
  }

  @Test func folderWriteIsAtomic() throws {
    struct Stop: Error {}
    try withTemporaryFolder { folder in
      let output = folder.appendingPathComponent("model")
      #expect(throws: Stop.self) {
        try AtomicDirectory.write(to: output) {
          try AtomicFile.write([1], to: $0.appendingPathComponent("a"))
          throw Stop()
        }
      }
      let names = try FileManager.default.contentsOfDirectory(atPath: folder.path)
      #expect(names == [])
    }
  }

  @Test func otherFilesOfAFolderAreKept() throws {
    try withTemporaryFolder { folder in
      let other = folder.appendingPathComponent("mine.txt")
      try AtomicFile.write([9], to: other)
      try AtomicFile.write([0], to: folder.appendingPathComponent("a"))
      try AtomicDirectory.write(to: folder) {
        try AtomicFile.write([1], to: $0.appendingPathComponent("a"))
        let inner = $0.appendingPathComponent("inner")
        try FileManager.default.createDirectory(at: inner, withIntermediateDirectories: false)
        try AtomicFile.write([2], to: inner.appendingPathComponent("b"))
      }
      #expect([UInt8](try Data(contentsOf: other)) == [9])
      #expect([UInt8](try Data(contentsOf: folder.appendingPathComponent("a"))) == [1])
      #expect([UInt8](try Data(contentsOf: folder.appendingPathComponent("inner/b"))) == [2])
    }
  }
}
