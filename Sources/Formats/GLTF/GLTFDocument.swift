/// The JSON part of a glTF 2.0 file, with the specification's names. Nil members are omitted, as
/// glTF forbids empty arrays.
struct GLTFDocument: Encodable {
  struct Asset: Encodable {
    var version = "2.0"
    var generator: String
  }

  struct Scene: Encodable {
    var nodes: [Int]?
  }

  struct Node: Encodable {
    var name: String
    var mesh: Int
    var translation: [Double]?
    var scale: [Double]?
  }

  struct Mesh: Encodable {
    var name: String
    var primitives: [Primitive]
  }

  struct Primitive: Encodable {
    struct Attributes: Encodable {
      var position: Int
      var normal: Int?
      var textureCoordinate: Int?

      enum CodingKeys: String, CodingKey {
        case position = "POSITION"
        case normal = "NORMAL"
        case textureCoordinate = "TEXCOORD_0"
      }
    }

    var attributes: Attributes
    var indices: Int
    var material: Int
  }

  struct Material: Encodable {
    struct MetallicRoughness: Encodable {
      var baseColorTexture: TextureReference?
      var metallicFactor = 0.0
      var roughnessFactor: Double
      var metallicRoughnessTexture: TextureReference?
    }

    var name: String
    var pbrMetallicRoughness: MetallicRoughness
    var normalTexture: TextureReference?
    var occlusionTexture: TextureReference?
  }

  struct TextureReference: Encodable {
    var index: Int
  }

  struct Texture: Encodable {
    struct Extensions: Encodable {
      struct WebP: Encodable {
        var source: Int
      }

      var webP: WebP

      enum CodingKeys: String, CodingKey {
        case webP = "EXT_texture_webp"
      }
    }

    var sampler = 0
    /// The image; nil if it is one of the extension.
    var source: Int?
    var extensions: Extensions?
  }

  struct Image: Encodable {
    var bufferView: Int
    var mimeType: String

    var isWebP: Bool { mimeType == "image/webp" }
  }

  struct Sampler: Encodable {
    /// Trilinear filtering, clamped: charts don't wrap around.
    var magFilter = 9729
    var minFilter = 9987
    var wrapS = 33071
    var wrapT = 33071
  }

  struct Accessor: Encodable {
    enum Component: Int, Encodable {
      case byte = 5120
      case unsignedShort = 5123
      case unsignedInt = 5125
      case float = 5126
    }

    var bufferView: Int
    var componentType: Component
    /// Whether integers stand for 0…1 or −1…1.
    var normalized: Bool?
    var count: Int
    /// `SCALAR`, `VEC2` or `VEC3`.
    var type: String
    var min: [Double]?
    var max: [Double]?
  }

  struct BufferView: Encodable {
    enum Target: Int, Encodable {
      case vertices = 34962
      case indices = 34963
    }

    struct Extensions: Encodable {
      var meshopt: CompressedView

      enum CodingKeys: String, CodingKey {
        case meshopt = "EXT_meshopt_compression"
      }
    }

    var buffer = 0
    var byteOffset: Int
    var byteLength: Int
    var byteStride: Int?
    var target: Target?
    var extensions: Extensions?
  }

  /// Where the content of a buffer view is compressed, and how.
  struct CompressedView: Encodable {
    enum Mode: String, Encodable {
      case attributes = "ATTRIBUTES"
      case triangles = "TRIANGLES"
    }

    enum Filter: String, Encodable {
      case octahedral = "OCTAHEDRAL"
    }

    var buffer = 0
    var byteOffset: Int
    var byteLength: Int
    /// Bytes per element, and number of elements, after decompression.
    var byteStride: Int
    var count: Int
    var mode: Mode
    var filter: Filter?
  }

  struct Buffer: Encodable {
    struct Extensions: Encodable {
      struct Fallback: Encodable {
        var fallback = true
      }

      var meshopt = Fallback()

      enum CodingKeys: String, CodingKey {
        case meshopt = "EXT_meshopt_compression"
      }
    }

    var byteLength: Int
    /// Marks a buffer without data, for views that are compressed elsewhere.
    var extensions: Extensions?
  }

  enum Extension: String, Encodable {
    case compression = "EXT_meshopt_compression"
    case quantization = "KHR_mesh_quantization"
    case webP = "EXT_texture_webp"
  }

  var asset: Asset
  var scene = 0
  var scenes = [Scene()]
  var nodes: [Node]?
  var meshes: [Mesh]?
  var materials: [Material]?
  var textures: [Texture]?
  var images: [Image]?
  var samplers: [Sampler]?
  var accessors: [Accessor]?
  var bufferViews: [BufferView]?
  var buffers: [Buffer]?
  var extensionsUsed: [Extension]?
  var extensionsRequired: [Extension]?
}
