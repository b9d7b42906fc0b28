// swift-tools-version: 6.2
import Foundation
import PackageDescription

// Programs as written for macOS, each as a separate target, and the examples. All of them are built
// in the language mode of CLIENT_LANGUAGE_MODE, 5 or 6.
let environment = ProcessInfo.processInfo.environment
let languageModes: [SwiftLanguageMode] = environment["CLIENT_LANGUAGE_MODE"] == "5" ? [.v5] : [.v6]

func module(_ name: String) -> Target.Dependency {
  .product(name: name, package: "photogrammetry-cli")
}

func program(_ name: String, _ modules: String..., others: [Target.Dependency] = []) -> Target {
  .executableTarget(name: name, dependencies: modules.map(module) + others)
}

let package = Package(
  name: "Clients",
  platforms: [.macOS(.v15)],
  dependencies: [
    .package(name: "photogrammetry-cli", path: "../.."),
    .package(url: "https://github.com/apple/swift-argument-parser", from: "1.4.0"),
  ],
  targets: [
    program(
      "DetailedCommand", "RealityKit", "Metal", "os",
      others: [.product(name: "ArgumentParser", package: "swift-argument-parser")]),
    program(
      "WatchedCommand", "RealityKit", "CoreGraphics", "os", "simd",
      others: [.product(name: "ArgumentParser", package: "swift-argument-parser")]),
    program("RunLoopProgram", "RealityKit", "os"),
    program("SemaphoreProgram", "RealityFoundation", "simd"),
    program("TopLevelLoop", "RealityKit"),
    program("AsyncMain", "RealityKit", "CoreGraphics", "CoreVideo", "ImageIO"),
    program(
      "EverySymbol", "RealityKit", "Combine", "CoreGraphics", "CoreImage", "CoreMotion",
      "CoreVideo", "ImageIO", "Metal", "OSLog", "QuartzCore", "os", "UniformTypeIdentifiers"),
    program("HelloPhotogrammetry", "RealityKit"),
    program("SampleSequence", "RealityKit", "CoreVideo"),
    program("MaskedSamples", "RealityKit", "CoreGraphics", "CoreVideo", "ImageIO"),
    program("SessionActor", "RealityKit", "os"),
    program("InterruptedCommand", "RealityKit", "OSLog"),
    program("ImageInventory", "CoreImage", "ImageIO", "os", "UniformTypeIdentifiers"),
    program("ObservedModel", "RealityKit", "Combine"),
  ],
  swiftLanguageModes: languageModes
)
