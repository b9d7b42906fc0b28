import Foundation
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct FolderStateTests {
  private static let mounts = """
    overlay / overlay rw 0 0
    tmpfs /tmp tmpfs rw 0 0
    /dev/sda1 /tmp/disk ext4 rw 0 0
    tmpfs /run/my\\040folder tmpfs rw 0 0
    tmpfs /var tmpfs rw 0 0
    /dev/sdb1 /var xfs rw 0 0
    damaged
    """

  @Test(arguments: [
    ("/home", "overlay"), ("/tmp", "tmpfs"), ("/tmp/a", "tmpfs"), ("/tmpfolder", "overlay"),
    ("/tmp/disk/a", "ext4"), ("/run/my folder", "tmpfs"), ("/var/tmp", "xfs"),
  ])
  func theInnermostMountPointCounts(path: String, type: String) {
    #expect(FolderState.fileSystem(of: path, mounts: Self.mounts) == type)
    #expect(FolderState.fileSystem(of: path, mounts: "") == nil)
  }

  @Test func theTemporaryFolderIsLeftAsItWas() throws {
    let state = FolderState.temporary
    #expect(state.isWritable && (state.freeBytes ?? 0) > 0)
  }
}
