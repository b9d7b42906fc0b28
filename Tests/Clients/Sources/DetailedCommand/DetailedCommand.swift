import ArgumentParser
import Foundation
import Metal
import RealityKit
import os

private let logger = Logger(subsystem: "com.example.clients", category: "DetailedCommand")

private typealias Configuration = PhotogrammetrySession.Configuration
private typealias Request = PhotogrammetrySession.Request

/// A command whose options are the session's own types.
@main
struct DetailedCommand: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "detailed-command", abstract: "Makes a model from a folder of photos.")

  @Argument(help: "The folder of photos.") var inputFolder: String

  @Argument(help: "The model to write.") var outputFilename: String

  @Option(
    name: .shortAndLong, parsing: .next, help: "The level of detail.",
    transform: Request.Detail.init(_:))
  private var detail: Request.Detail? = nil

  @Option(
    name: [.customShort("o"), .long], parsing: .next, help: "unordered or sequential.",
    transform: Configuration.SampleOrdering.init(sampleOrdering:))
  private var sampleOrdering: Configuration.SampleOrdering?

  @Option(
    name: .shortAndLong, parsing: .next, help: "normal or high.",
    transform: Configuration.FeatureSensitivity.init(featureSensitivity:))
  private var featureSensitivity: Configuration.FeatureSensitivity?

  func run() {
    guard Self.hasCapableDevice else {
      logger.error("This machine can't make models.")
      print("This machine can't make models.")
      return
    }
    let inputFolderURL = URL(fileURLWithPath: inputFolder, isDirectory: true)
    let configuration = makeConfiguration()
    logger.log("Configuration: \(String(describing: configuration), privacy: .public)")

    var maybeSession: PhotogrammetrySession? = nil
    do {
      maybeSession = try PhotogrammetrySession(input: inputFolderURL, configuration: configuration)
    } catch {
      logger.error("No session: \(String(describing: error))")
      Foundation.exit(1)
    }
    guard let session = maybeSession else { Foundation.exit(1) }

    let waiter = Task {
      do {
        for try await output in session.outputs {
          switch output {
          case .processingComplete:
            logger.log("Processing is complete!")
            Foundation.exit(0)
          case .requestError(let request, let error):
            logger.error(
              "Request \(String(describing: request)) failed: \(String(describing: error))")
          case .requestComplete(let request, let result):
            Self.handleRequestComplete(request: request, result: result)
          case .requestProgress(let request, let fractionComplete):
            Self.handleRequestProgress(request: request, fractionComplete: fractionComplete)
          case .inputComplete:
            logger.log("Ingestion is complete, beginning processing…")
          case .invalidSample(let id, let reason):
            logger.warning("Invalid sample! id=\(id) reason=\"\(reason)\"")
          case .skippedSample(let id):
            logger.warning("Sample id=\(id) was skipped.")
          case .automaticDownsampling:
            logger.warning("Downsampling!")
          case .processingCancelled:
            logger.warning("Processing was canceled.")
          case .requestProgressInfo, .stitchingIncomplete:
            continue
          @unknown default:
            logger.error("Unhandled output: \(output.localizedDescription)")
          }
        }
      } catch {
        logger.error("Output: ERROR = \(String(describing: error))")
        Foundation.exit(0)
      }
    }

    withExtendedLifetime((session, waiter)) {
      do {
        let request = makeRequest()
        logger.log("Using request: \(String(describing: request))")
        try session.process(requests: [request])
        RunLoop.main.run()
      } catch {
        logger.critical("Process got error: \(String(describing: error))")
        Foundation.exit(1)
      }
    }
  }

  private static var hasCapableDevice: Bool {
    for device in MTLCopyAllDevices()
    where !device.isLowPower && device.areBarycentricCoordsSupported
      && device.recommendedMaxWorkingSetSize >= UInt64(4e9)
    {
      return MTLCopyAllDevices().contains { $0.supportsRaytracing }
    }
    return false
  }

  private func makeConfiguration() -> PhotogrammetrySession.Configuration {
    var configuration = PhotogrammetrySession.Configuration()
    sampleOrdering.map { configuration.sampleOrdering = $0 }
    featureSensitivity.map { configuration.featureSensitivity = $0 }
    return configuration
  }

  private func makeRequest() -> PhotogrammetrySession.Request {
    let outputURL = URL(fileURLWithPath: outputFilename)
    if let detailSetting = detail {
      return PhotogrammetrySession.Request.modelFile(url: outputURL, detail: detailSetting)
    } else {
      return PhotogrammetrySession.Request.modelFile(url: outputURL)
    }
  }

  private static func handleRequestComplete(
    request: PhotogrammetrySession.Request, result: PhotogrammetrySession.Result
  ) {
    logger.log("Request complete: \(String(describing: request))")
    switch result {
    case .modelFile(let url):
      logger.log("\tmodelFile available at url=\(url)")
    default:
      logger.warning("\tUnexpected result: \(String(describing: result))")
    }
  }

  private static func handleRequestProgress(
    request: PhotogrammetrySession.Request, fractionComplete: Double
  ) {
    logger.debug("Progress(request = \(String(describing: request)) = \(fractionComplete)")
  }
}

private enum IllegalOption: Swift.Error {
  case invalidDetail(String)
  case invalidSampleOrdering(String)
  case invalidFeatureSensitivity(String)
}

extension PhotogrammetrySession.Request.Detail {
  init(_ detail: String) throws {
    switch detail {
    case "preview": self = .preview
    case "reduced": self = .reduced
    case "medium": self = .medium
    case "full": self = .full
    case "raw": self = .raw
    default: throw IllegalOption.invalidDetail(detail)
    }
  }
}

extension PhotogrammetrySession.Configuration.SampleOrdering {
  init(sampleOrdering: String) throws {
    if sampleOrdering == "unordered" {
      self = .unordered
    } else if sampleOrdering == "sequential" {
      self = .sequential
    } else {
      throw IllegalOption.invalidSampleOrdering(sampleOrdering)
    }
  }
}

extension PhotogrammetrySession.Configuration.FeatureSensitivity {
  init(featureSensitivity: String) throws {
    if featureSensitivity == "normal" {
      self = .normal
    } else if featureSensitivity == "high" {
      self = .high
    } else {
      throw IllegalOption.invalidFeatureSensitivity(featureSensitivity)
    }
  }
}
