import ArgumentParser
import Formats
import Foundation
import Kernels
import Pipeline
import RealityFoundation
import SharedCommands

/// This project's engine.
package enum PipelineEngine: EngineSupport {
  package typealias Arguments = PipelineArguments

  package static var commands: [any ParsableCommand.Type] {
    [
      Batch.self, Align.self, Densify.self, Export.self, View.self, Inspect.self,
      Evaluate.self, CheckModel.self, Doctor.self, Frames.self, Demo<Self>.self,
      MakeChunk.self, JoinChunks.self, WatchPlan.self,
    ]
  }
  package static let modelFormats = ModelFormat.files
  package static let sessionOutputSource: String? = RealityFoundation.sessionOutputSource

  package static var unsupportedMachine: CommandFailure {
    let machine = Machine.current
    return .run(
      machine.shortfalls.joined(separator: " "),
      isTransient: machine.totalMemoryBytes >= Machine.neededMemoryBytes)
  }

  package static var versions: String { NativeLibraries.versions }

  /// Keeps the native libraries from writing to standard error.
  package static func prepareProcess() { NativeLibraries.silence() }

  package static func isTransient(_ error: any Error) -> Bool {
    CommandFailure.isTransient(error)
  }

  package static func intrinsics(
    of pose: PhotogrammetrySession.Pose
  ) -> PosesFile.Intrinsics? {
    pose.intrinsics.map { k in
      PosesFile.Intrinsics(
        focalLength: [k.columns.0.x, k.columns.1.y],
        principalPoint: [k.columns.2.x, k.columns.2.y])
    }
  }

  package static func addCounts(of session: PhotogrammetrySession, to event: inout RunEvent) {
    guard let report = session.report else { return }
    event.photos = report.photos.count
    event.registered = report.photos.count { $0.status == .registered }
    let textured = report.stages.last { $0.name == PipelineStage.textureMapping.rawValue }
    event.triangles = textured?.counts["triangles"].map { Int($0) }
    var quality = RunQuality()
    quality.verdict = report.assessed.verdict?.level.rawValue
    quality.reprojection = report.meanReprojectionError
    quality.missingShare = report.surface?.missingShare
    quality.outlineShare = report.surface?.outlineShare
    event.quality = quality
  }

  package static func concerns(about session: PhotogrammetrySession) -> [String] {
    session.report?.concerns ?? []
  }
}

extension PipelineEngine {
  /// The sections of help on models, masks and the scale, with examples and the event `plan`.
  package static var help: EngineHelp {
    var help = EngineHelp()
    help.examples = """
        photogrammetry-cli photos/ model.usdz --preview model.png
            Also renders the model from eight sides into one picture.
        photogrammetry-cli photos/ shop.glb -d custom --max-polygons 20000 \\
            --texture-side 1024 --maps color --texture-format jpeg:0.7
            Custom limits, for a web shop.
        photogrammetry-cli clip.mov model.usdz
            Of a video: sharp frames at even distances become photos.

      """
    help.outputs = """
      OUTPUT
        model.usdz  for AR Quick Look, usdview, Blender
        model.glb   glTF 2.0, for browsers, game engines, Blender; no displacement
        model.ply   the mesh with a normal and a color per vertex; no textures
        model/      folder with OBJ, MTL, USDA and textures

      """
    help.input = [
      VideoArguments.help, MaskOutputArguments.help, MaskArguments.help, ScaleArguments.help,
      SlurmArguments.help,
    ]
    .joined(separator: "\n")
    help.events = """
        plan                 with --dry-run: path, photos, expectedSeconds,
                             memoryBytes, diskBytes

      """
    return help
  }
}
