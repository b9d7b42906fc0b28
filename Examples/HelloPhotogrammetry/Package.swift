// swift-tools-version: 6.2
import PackageDescription

// On macOS the system provides these modules.
#if os(Linux)
  let modules = ["RealityKit"]
#else
  let modules: [String] = []
#endif

let package = Package(
  name: "HelloPhotogrammetry",
  platforms: [.macOS(.v15)],
  dependencies: [.package(name: "photogrammetry-cli", path: "../..")],
  targets: [
    .executableTarget(
      name: "HelloPhotogrammetry",
      dependencies: modules.map { .product(name: $0, package: "photogrammetry-cli") })
  ]
)
