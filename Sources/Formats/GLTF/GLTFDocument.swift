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
    var sampler = 0
    var source: Int
  }

  struct Image: Encodable {
    var bufferView: Int
    var mimeType: String
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
      case unsignedInt = 5125
      case float = 5126
    }

    var bufferView: Int
    var componentType: Component
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

    var buffer = 0
    var byteOffset: Int
    var byteLength: Int
    var target: Target?
  }

  struct Buffer: Encodable {
    var byteLength: Int
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
}
