import ArgumentParser
import Formats
import Pipeline
import SharedCommands

/// Compression of model files.
struct CompressionArguments: ParsableArguments {
  @Flag(
    name: .long,
    help: """
      Compress a GLB file to about a seventh, for the web: quantized and compressed geometry, WebP \
      textures. Readers must support EXT_meshopt_compression, KHR_mesh_quantization and \
      EXT_texture_webp, as three.js does; Blender 5.0 does not.
      """)
  var compress = false

  /// Throws a `CommandFailure` if models in `format` can't be compressed, or if the textures have a
  /// format already.
  func check(_ format: ModelFormat, _ detail: DetailArguments) throws {
    guard compress else { return }
    guard format == .glb else {
      throw CommandFailure.usage(
        "--compress is for GLB files. Name a .glb file, or omit --compress.")
    }
    guard detail.textureFormat == nil else {
      throw CommandFailure.usage(
        "--compress stores textures as WebP. Omit --texture-format or --compress.")
    }
  }

  func apply(to configuration: inout PipelineConfiguration) {
    configuration.export.glbCompression = compress ? GLBCompression() : nil
  }
}
