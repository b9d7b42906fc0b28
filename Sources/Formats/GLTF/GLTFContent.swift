/// What a reader uses of the JSON of a glTF file. No index is checked.
struct GLTFContent: Decodable {
  struct Scene: Decodable {
    var nodes: [Int]?
  }

  struct Node: Decodable {
    var mesh: Int?
    var children: [Int]?
    var matrix: [Double]?
    var translation: [Double]?
    var rotation: [Double]?
    var scale: [Double]?
  }

  struct Mesh: Decodable {
    var primitives: [Primitive]
  }

  struct Primitive: Decodable {
    var attributes: [String: Int]
    var indices: Int?
    var material: Int?
    /// The topology; nil for triangles.
    var mode: Int?
  }

  struct Material: Decodable {
    struct MetallicRoughness: Decodable {
      var baseColorFactor: [Double]?
      var baseColorTexture: TextureReference?
    }

    struct SpecularGlossiness: Decodable {
      var diffuseFactor: [Double]?
      var diffuseTexture: TextureReference?
    }

    struct Extensions: Decodable {
      var specularGlossiness: SpecularGlossiness?

      enum CodingKeys: String, CodingKey {
        case specularGlossiness = "KHR_materials_pbrSpecularGlossiness"
      }
    }

    var pbrMetallicRoughness: MetallicRoughness?
    var extensions: Extensions?
  }

  struct TextureReference: Decodable {
    struct Transform: Decodable {
      var offset: [Double]?
      var rotation: Double?
      var scale: [Double]?
      var texCoord: Int?
    }

    struct Extensions: Decodable {
      var transform: Transform?

      enum CodingKeys: String, CodingKey {
        case transform = "KHR_texture_transform"
      }
    }

    var index: Int
    var texCoord: Int?
    var extensions: Extensions?
  }

  struct Texture: Decodable {
    struct Extensions: Decodable {
      struct WebP: Decodable {
        var source: Int?
      }

      var webP: WebP?

      enum CodingKeys: String, CodingKey {
        case webP = "EXT_texture_webp"
      }
    }

    var source: Int?
    var extensions: Extensions?
  }

  struct Image: Decodable {
    var bufferView: Int?
    var uri: String?
    var name: String?
  }

  struct Accessor: Decodable {
    struct Sparse: Decodable {}

    var bufferView: Int?
    var byteOffset: Int?
    var componentType: Int
    var normalized: Bool?
    var count: Int
    var type: String
    var sparse: Sparse?
  }

  struct BufferView: Decodable {
    struct Extensions: Decodable {
      var meshopt: CompressedView?

      enum CodingKeys: String, CodingKey {
        case meshopt = "EXT_meshopt_compression"
      }
    }

    var buffer: Int
    var byteOffset: Int?
    var byteLength: Int
    var byteStride: Int?
    var extensions: Extensions?
  }

  struct CompressedView: Decodable {
    var buffer: Int
    var byteOffset: Int?
    var byteLength: Int
    var byteStride: Int
    var count: Int
    var mode: String
    var filter: String?
  }

  struct Buffer: Decodable {
    var uri: String?
    var byteLength: Int
  }

  var scene: Int?
  var scenes: [Scene]?
  var nodes: [Node]?
  var meshes: [Mesh]?
  var materials: [Material]?
  var textures: [Texture]?
  var images: [Image]?
  var accessors: [Accessor]?
  var bufferViews: [BufferView]?
  var buffers: [Buffer]?
  var extensionsRequired: [String]?
}
