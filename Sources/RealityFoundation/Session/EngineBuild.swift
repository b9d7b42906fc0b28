/// How the compiler built the engine.
package struct EngineBuild {
  /// Whether code was optimized. SwiftPM defines `DEBUG` for all packages of a debug build.
  package var isOptimized: Bool

  package init(isOptimized: Bool) { self.isOptimized = isOptimized }

  /// This build.
  package static var current: EngineBuild {
    #if DEBUG
      EngineBuild(isOptimized: false)
    #else
      EngineBuild(isOptimized: true)
    #endif
  }

  /// A sentence with a remedy if runs of this build are slow.
  package var warning: String? {
    isOptimized
      ? nil
      : "The engine was compiled without optimization, with which it is about 30 times faster: "
        + "build the program with 'swift build -c release'."
  }

  /// Logs the warning; only the first use in a process has an effect.
  static let warnOnce: Void = {
    if let warning = current.warning { sessionLogger.warning("\(warning)") }
  }()
}
