// swift-tools-version: 6.2
import PackageDescription

// The command line as compiled on macOS: the same sources with Apple's engine, in a separate
// package, which has access only to the public API of the modules that replace Apple's.

/// The platform-independent modules are compiled again, with aliases: the `package` declarations of
/// the engine's package are not accessible from here.
let modules = ["SceneModel", "Formats", "SharedCommands"]
let settings: [SwiftSetting] = [
  .define("APPLE_ENGINE"), .treatAllWarnings(as: .error),
  .unsafeFlags(modules.flatMap { ["-module-alias", "\($0)=Mac\($0)"] }),
]

func module(_ name: String, _ dependencies: [Target.Dependency]) -> Target {
  .target(
    name: "Mac" + name, dependencies: dependencies, path: "Sources/\(name)",
    swiftSettings: settings)
}

let argumentParser = Target.Dependency.product(
  name: "ArgumentParser", package: "swift-argument-parser")

let package = Package(
  name: "MacCommandLine",
  platforms: [.macOS(.v15)],
  dependencies: [
    .package(name: "photogrammetry-cli", path: "../.."),
    .package(url: "https://github.com/apple/swift-argument-parser", from: "1.4.0"),
    .package(url: "https://github.com/apple/swift-log", from: "1.5.4"),
  ],
  targets: [
    module("SceneModel", []),
    module("Formats", ["MacSceneModel"]),
    module(
      "SharedCommands",
      [
        "MacSceneModel", "MacFormats", argumentParser,
        .product(name: "Logging", package: "swift-log"),
        .product(name: "RealityKit", package: "photogrammetry-cli"),
      ]),
    .executableTarget(
      name: "mac-command-line",
      dependencies: ["MacSceneModel", "MacSharedCommands", argumentParser],
      path: "Sources/photogrammetry-cli", swiftSettings: settings),
  ]
)
