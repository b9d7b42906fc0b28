import Foundation
import Kernels
import Pipeline
import RealityFoundation
import VideoFiles

extension DoctorReport {
  /// Checks this machine. Decodes images, and creates and removes a temporary folder.
  static func ofThisMachine() -> DoctorReport {
    let machine = Machine.current
    let environment = ProcessInfo.processInfo.environment
    let checks: [Check?] = [
      .version(
        of: .current, fingerprint: ProgramIdentity.fingerprint, system: SystemDescription.name),
      .memory(of: machine),
      .threads(.current),
      .instructions(Instructions.supported, of: machine),
      .imageFormats(failures: SampleImage.failures(), leftOut: SampleImage.leftOut()),
      .video(.current),
      .temporaryFolder(.temporary),
      .currentFolder(.current),
      .scheduler(
        environment: environment, hasBatchCommand: isOnPath("sbatch", environment["PATH"] ?? "")),
      .terminal(environment: environment, isTerminal: isatty(STDERR_FILENO) == 1),
    ]
    return DoctorReport(checks.compactMap(\.self))
  }

  /// Whether a folder of `path` holds an executable file `name`.
  static func isOnPath(_ name: String, _ path: String) -> Bool {
    path.split(separator: ":").contains {
      FileManager.default.isExecutableFile(atPath: "\($0)/\(name)")
    }
  }
}
