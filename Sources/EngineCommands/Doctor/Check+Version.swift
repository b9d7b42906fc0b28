import Kernels
import Pipeline
import RealityFoundation
import SceneModel

extension Check {
  /// The version, and the build: results of different builds may differ.
  static func version(of build: EngineBuild, fingerprint: UInt64, system: String) -> Check {
    let text = "\(ProgramVersion.current), build \(fingerprint.hexadecimalDigits), on \(system)."
    guard !build.isOptimized else { return Check(.version, .ok, text) }
    return Check(
      .version, .note, "\(text) It was compiled without optimization and is about 30 times slower.",
      remedy: "Build it with 'swift build -c release', or use scripts/build.")
  }
}
