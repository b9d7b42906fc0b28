// swift-tools-version: 6.2
import PackageDescription

/// A module of the engine; on a Mac the system has it.
func engine(_ module: String) -> Target.Dependency {
  .product(
    name: module, package: "photogrammetry-cli", condition: .when(platforms: [.linux]))
}

let package = Package(
  name: "SampleSequence",
  platforms: [.macOS(.v15)],
  dependencies: [.package(name: "photogrammetry-cli", path: "../..")],
  targets: [
    .executableTarget(
      name: "SampleSequence", dependencies: [engine("RealityKit"), engine("CoreVideo")])
  ]
)
