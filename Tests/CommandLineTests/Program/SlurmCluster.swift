import Foundation
import TestSupport

/// A Slurm of two nodes on this machine, which ends with the value.
final class SlurmCluster {
  let folder: TemporaryFolder

  /// Why there can be no cluster here; nil if there can.
  static let shortfall: String? = {
    guard geteuid() == 0 else { return "needs root" }
    let programs = ["/usr/sbin/slurmctld", "/usr/sbin/slurmd", "/usr/sbin/munged"]
    guard programs.allSatisfy({ FileManager.default.isExecutableFile(atPath: $0) }) else {
      return "the packages slurm-wlm and munge are not installed"
    }
    do {
      _ = try SlurmCluster()
      return nil
    } catch {
      return "no cluster can be started here: \(error.localizedDescription)"
    }
  }()

  init() throws {
    folder = try TemporaryFolder()
    try control("start")
  }

  deinit { try? control("stop") }

  /// The variables of a process that uses the cluster.
  var environment: [String: String] {
    ["SLURM_CONF": folder.url.appendingPathComponent("slurm.conf").path]
  }

  /// The memory of a node.
  func megabytesPerNode() throws -> Int {
    let configuration = try String(
      contentsOf: folder.url.appendingPathComponent("slurm.conf"), encoding: .utf8)
    let value = configuration.components(separatedBy: "RealMemory=").last?.prefix { $0.isNumber }
    guard let megabytes = value.flatMap({ Int($0) }) else { throw CocoaError(.fileReadCorruptFile) }
    return megabytes
  }

  /// Ends the daemon of a node, as if its machine had lost power.
  func kill(_ node: String) throws { try control("kill", node) }

  /// Starts the daemon of a node again.
  func revive(_ node: String) throws { try control("revive", node) }

  private func control(_ verb: String, _ arguments: String...) throws {
    let script = Fixtures.folder("orbit").deletingLastPathComponent().deletingLastPathComponent()
      .appendingPathComponent("scripts/slurm-cluster")
    let process = Process()
    process.executableURL = script
    process.arguments = [verb, folder.url.path] + arguments
    process.standardInput = FileHandle.nullDevice
    // The daemons inherit them.
    process.standardOutput = FileHandle.nullDevice
    process.standardError = FileHandle.nullDevice
    try process.run()
    process.waitUntilExit()
    guard process.terminationStatus == 0 else {
      throw CocoaError(
        .executableLoad, userInfo: [NSLocalizedDescriptionKey: "slurm-cluster \(verb) failed"])
    }
  }
}
