// swift-tools-version: 6.2
import PackageDescription

let argumentParser = Target.Dependency.product(
  name: "ArgumentParser", package: "swift-argument-parser")
let logging = Target.Dependency.product(name: "Logging", package: "swift-log")

let strict: [SwiftSetting] = [.treatAllWarnings(as: .error)]

let strictCxx: [CXXSetting] = [
  .headerSearchPath("."),
  .headerSearchPath("../SystemLibraries/COpenCV"),
  .enableWarning("all"),
  .treatAllWarnings(as: .error),
]

/// A library of the system; see `Sources/SystemLibraries/README.md`.
func systemLibrary(_ name: String, pkgConfig: String? = nil, apt packages: [String]) -> Target {
  .systemLibrary(
    name: name, path: "Sources/SystemLibraries/\(name)", pkgConfig: pkgConfig,
    providers: [.apt(packages)])
}

/// A module that stands in for one of Apple's; see `Sources/AppleModules/README.md`.
func appleModule(_ name: String, _ dependencies: [Target.Dependency] = []) -> Target {
  .target(
    name: name, dependencies: dependencies, path: "Sources/AppleModules/\(name)",
    swiftSettings: strict)
}

var products: [Product] = [
  .executable(name: "photogrammetry-cli", targets: ["photogrammetry-cli"])
]
var targets: [Target] = [
  .target(name: "SceneModel", swiftSettings: strict),
  .target(name: "Formats", dependencies: ["SceneModel"], swiftSettings: strict),
  .target(
    name: "DamagedInput", dependencies: ["SceneModel"], path: "Tests/DamagedInput",
    swiftSettings: strict),
  .target(name: "TestFiles", path: "Tests/TestFiles", swiftSettings: strict),
  .testTarget(name: "SceneModelTests", dependencies: ["SceneModel"], swiftSettings: strict),
  .testTarget(
    name: "FormatsTests", dependencies: ["Formats", "SceneModel", "DamagedInput", "TestFiles"],
    swiftSettings: strict),
]
// The command line for any engine; on macOS it is linked against Apple's RealityKit.
var sharedCommands: [Target.Dependency] = [
  argumentParser, logging, "Formats", "SceneModel",
]
var program: [Target.Dependency] = [argumentParser, "SharedCommands", "SceneModel"]

// The engine, and the modules that stand in for Apple's, are for Linux.
#if os(Linux)
  products += ["RealityKit", "RealityFoundation"].map { .library(name: $0, targets: [$0]) }
  // What else programs for the Mac import; a program names those that it needs.
  products += [
    "Combine", "CoreGraphics", "CoreImage", "CoreMotion", "CoreVideo", "ImageIO", "Metal", "OSLog",
    "QuartzCore", "os", "simd", "UniformTypeIdentifiers",
  ].map { .library(name: $0, targets: [$0]) }
  targets += [
    .target(
      name: "CKernels",
      dependencies: [
        "CDeflate", "CEigen", "CEmbree", "CHEIF", "CJPEG", "CLittleCMS", "CMeshOptimizer",
        "CNanoflann", "COpenCV", "COpenEXR", "CPNG", "CRaw", "CTIFF", "CWebP", "CXXHash",
      ],
      cxxSettings: strictCxx,
      linkerSettings: [  // Libraries without a usable pkg-config file.
        .linkedLibrary("opencv_core"), .linkedLibrary("opencv_imgproc"), .linkedLibrary("embree3"),
        .linkedLibrary("meshoptimizer"), .linkedLibrary("dl"), .linkedLibrary("raw_r"),
        .linkedLibrary("gomp"), .linkedLibrary("OpenEXRCore"),
      ]),
    systemLibrary("CDeflate", pkgConfig: "libdeflate", apt: ["libdeflate-dev"]),
    systemLibrary("CEigen", pkgConfig: "eigen3", apt: ["libeigen3-dev"]),
    systemLibrary("CEmbree", apt: ["libembree-dev"]),
    systemLibrary("CHEIF", pkgConfig: "libheif", apt: ["libheif-dev"]),
    systemLibrary("CJPEG", pkgConfig: "libjpeg", apt: ["libjpeg-dev"]),
    systemLibrary("CLittleCMS", pkgConfig: "lcms2", apt: ["liblcms2-dev"]),
    systemLibrary("CMeshOptimizer", apt: ["libmeshoptimizer-dev"]),
    systemLibrary("CNanoflann", apt: ["libnanoflann-dev"]),
    systemLibrary(
      "COpenCV",
      apt: ["libopencv-core-dev", "libopencv-imgproc-dev"]),
    systemLibrary("COpenEXR", apt: ["libopenexr-dev"]),
    systemLibrary("CPNG", pkgConfig: "libpng", apt: ["libpng-dev"]),
    systemLibrary("CRaw", apt: ["libraw-dev"]),
    systemLibrary("CTIFF", pkgConfig: "libtiff-4", apt: ["libtiff-dev"]),
    systemLibrary("CWebP", pkgConfig: "libwebp", apt: ["libwebp-dev"]),
    systemLibrary("CXXHash", pkgConfig: "libxxhash", apt: ["libxxhash-dev"]),
    .target(name: "Kernels", dependencies: ["CKernels", "SceneModel"], swiftSettings: strict),
    .target(
      name: "ImageFiles", dependencies: ["CKernels", "Kernels", "SceneModel"],
      swiftSettings: strict),
    .target(
      name: "VideoFiles", dependencies: ["CKernels", "Kernels", "ImageFiles", "SceneModel"],
      swiftSettings: strict),
    .target(
      name: "Pipeline", dependencies: ["Kernels", "ImageFiles", "Formats", "SceneModel"],
      swiftSettings: strict),
    .target(
      name: "ReportPages", dependencies: ["Formats", "Kernels"],
      resources: [.embedInCode("Resources")], swiftSettings: strict),
    .target(
      name: "SceneRendering", dependencies: ["ImageFiles", "Kernels", "SceneModel"],
      swiftSettings: strict),
    .target(
      name: "Evaluation",
      dependencies: ["SceneRendering", "ImageFiles", "Kernels", "Formats", "SceneModel"],
      swiftSettings: strict),
    appleModule("CoreFoundationTypes"),
    appleModule("BitmapGraphics", ["CoreFoundationTypes", "Kernels", "SceneModel"]),
    appleModule("Combine"),
    appleModule("CoreGraphics", ["BitmapGraphics"]),
    appleModule("CoreImage", ["BitmapGraphics", "CoreVideo", "ImageIO", "Metal", "SceneModel"]),
    appleModule("CoreMotion"),
    appleModule("CoreVideo", ["CoreFoundationTypes", "SceneModel"]),
    appleModule(
      "ImageIO", ["BitmapGraphics", "CoreFoundationTypes", "ImageFiles", "Kernels", "SceneModel"]),
    appleModule("Metal"),
    .target(name: "OSLogModule", path: "Sources/AppleModules/OSLogModule"),
    appleModule("OSLog", ["os"]),
    appleModule("QuartzCore", ["CoreFoundationTypes"]),
    appleModule("UniformTypeIdentifiers"),
    appleModule("os", ["OSLogModule", logging]),
    appleModule("simd"),
    .target(
      name: "RealityFoundation",
      dependencies: [
        "Pipeline", "Kernels", "ImageFiles", "Formats", "SceneModel", "BitmapGraphics",
        "CoreMotion", "CoreVideo", "ImageIO", "os", "simd", logging,
      ],
      swiftSettings: strict),
    .target(name: "RealityKit", dependencies: ["RealityFoundation"], swiftSettings: strict),
    // The commands and options that only this package's engine has.
    .target(
      name: "EngineCommands",
      dependencies: [
        argumentParser, logging, "SharedCommands", "RealityFoundation", "Pipeline",
        "ReportPages", "SceneRendering", "VideoFiles", "ImageFiles", "Kernels", "Evaluation",
        "Formats", "SceneModel",
      ],
      swiftSettings: strict),
    .target(
      name: "TestSupport",
      dependencies: ["SceneModel", "SceneRendering", "Kernels", "ImageFiles", "TestFiles"],
      path: "Tests/TestSupport", swiftSettings: strict),
    .target(name: "TestLevels", path: "Tests/TestLevels", swiftSettings: strict),
    .executableTarget(
      name: "render-fixtures",
      dependencies: ["TestSupport", "SceneModel", "Kernels", "ImageFiles", "Formats"],
      path: "Tests/FixtureRenderer", swiftSettings: strict),
    .executableTarget(
      name: "growth-benchmark",
      dependencies: [
        argumentParser, "TestSupport", "Pipeline", "Evaluation", "SceneModel", "Kernels",
      ],
      path: "Tests/GrowthBenchmark", swiftSettings: strict),
    .executableTarget(
      name: "cancel-benchmark", dependencies: [argumentParser, "RealityFoundation", "SceneModel"],
      path: "Tests/CancelBenchmark", swiftSettings: strict),
    .executableTarget(
      name: "library-benchmark",
      dependencies: [
        argumentParser, "Formats", "ImageFiles", "Kernels", "SceneModel",
      ],
      path: "Tests/LibraryBenchmark", swiftSettings: strict),
    .testTarget(
      name: "KernelsTests",
      dependencies: ["CKernels", "Kernels", "SceneModel", "TestLevels", "TestSupport"],
      swiftSettings: strict),
    .testTarget(
      name: "ImageFilesTests",
      dependencies: ["DamagedInput", "ImageFiles", "Kernels", "SceneModel", "TestSupport"],
      swiftSettings: strict),
    .testTarget(
      name: "VideoFilesTests",
      dependencies: [
        "DamagedInput", "VideoFiles", "ImageFiles", "Kernels", "SceneModel", "TestSupport",
      ],
      swiftSettings: strict),
    .testTarget(
      name: "ReportPagesTests", dependencies: ["ReportPages"], swiftSettings: strict),
    .testTarget(
      name: "AppleModulesTests",
      dependencies: [
        "BitmapGraphics", "Combine", "CoreFoundationTypes", "CoreImage", "CoreMotion", "CoreVideo",
        "ImageFiles", "ImageIO", "Metal", "OSLog", "QuartzCore", "SceneModel", "TestSupport",
        "UniformTypeIdentifiers", "os", "simd", logging,
      ],
      swiftSettings: strict),
    .testTarget(
      name: "EvaluationTests",
      dependencies: [
        "Evaluation", "DamagedInput", "Formats", "ImageFiles", "Kernels", "SceneModel",
        "TestSupport",
      ],
      swiftSettings: strict),
    .testTarget(
      name: "PipelineTests",
      dependencies: [
        "Pipeline", "DamagedInput", "Evaluation", "Formats", "ImageFiles", "Kernels", "SceneModel",
        "TestLevels", "TestSupport",
      ],
      swiftSettings: strict),
    .testTarget(
      name: "RealityFoundationTests",
      dependencies: [
        "RealityKit", "RealityFoundation", "Pipeline", "Formats", "ImageFiles", "Kernels",
        "SceneModel", "TestLevels", "TestSupport",
      ],
      swiftSettings: strict),
    .testTarget(
      name: "CommandLineTests",
      dependencies: [
        argumentParser, "photogrammetry-cli", "SharedCommands", "EngineCommands", "Evaluation",
        "Formats", "Pipeline", "VideoFiles", "ImageFiles", "Kernels", "RealityFoundation",
        "RealityKit", "SceneModel", "TestLevels", "TestSupport",
      ],
      exclude: ["Snapshots"], swiftSettings: strict),
  ]
  sharedCommands.append("RealityFoundation")
  program.append("EngineCommands")
#endif

targets += [
  .target(name: "SharedCommands", dependencies: sharedCommands, swiftSettings: strict),
  .executableTarget(
    name: "photogrammetry-cli", dependencies: program,
    swiftSettings: strict + [.define("APPLE_ENGINE", .when(platforms: [.macOS]))]),
]

let package = Package(
  name: "photogrammetry-cli",
  platforms: [.macOS(.v15)],
  products: products,
  dependencies: [
    // The lowest versions are the ones that tests run with where `scripts/setup` provides them. All
    // of a major version is accepted, because programs that use this package name these, too.
    .package(url: "https://github.com/apple/swift-argument-parser", "1.4.0"..<"2.0.0"),
    .package(url: "https://github.com/apple/swift-log", "1.5.4"..<"2.0.0"),
  ],
  targets: targets,
  cxxLanguageStandard: .cxx17
)
