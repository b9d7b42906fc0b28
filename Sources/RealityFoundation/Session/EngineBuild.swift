/// How the compiler built the engine.
struct EngineBuild {
  /// Whether code was optimized. SwiftPM defines `DEBUG` for all packages of a debug build.
  var isOptimized: Bool

  /// This build.
  static var current: EngineBuild {
    #if DEBUG
      EngineBuild(isOptimized: false)
    #else
      EngineBuild(isOptimized: true)
    #endif
  }

  /// A sentence with a remedy if runs of this build are slow.
  var warning: String? {
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
