import SceneModel

/// Reads the numbers of accessors of an untrusted glTF file.
extension GLTFBuffers {
  private enum Component: Int {
    case byte = 5120
    case unsignedByte = 5121
    case short = 5122
    case unsignedShort = 5123
    case unsignedInt = 5125
    case float = 5126

    var size: Int {
      switch self {
      case .byte, .unsignedByte: 1
      case .short, .unsignedShort: 2
      case .unsignedInt, .float: 4
      }
    }

    /// What stands for 1 in normalized numbers.
    var one: Float {
      switch self {
      case .byte: 127
      case .unsignedByte: 255
      case .short: 32767
      case .unsignedShort: 65535
      case .unsignedInt: 0x1p32
      case .float: 1
      }
    }

    func number(_ buffer: UnsafeRawBufferPointer, _ offset: Int) -> Float {
      switch self {
      case .byte: Float(buffer.loadUnaligned(fromByteOffset: offset, as: Int8.self))
      case .unsignedByte: Float(buffer[offset])
      case .short: Float(buffer.loadUnaligned(fromByteOffset: offset, as: Int16.self))
      case .unsignedShort: Float(buffer.loadUnaligned(fromByteOffset: offset, as: UInt16.self))
      case .unsignedInt: Float(buffer.loadUnaligned(fromByteOffset: offset, as: UInt32.self))
      case .float: buffer.loadUnaligned(fromByteOffset: offset, as: Float.self)
      }
    }
  }

  /// Where the elements of an accessor are.
  private struct Layout {
    var bytes: ArraySlice<UInt8>
    var component: Component
    var isNormalized: Bool
    var count: Int
    /// Components per element.
    var width: Int
    var stride: Int
  }

  /// The number of elements of an accessor.
  func count(of accessor: Int) throws -> Int {
    try Self.element(content.accessors, accessor, "accessor").count
  }

  /// The vectors of an accessor with their components one after the other, and their number of
  /// components. Normalized integers become 0…1 or −1…1.
  mutating func vectors(_ accessor: Int) throws -> (numbers: [Float], width: Int) {
    let layout = try layout(accessor)
    let scale = layout.isNormalized ? 1 / layout.component.one : 1
    try budget.spend(layout.count, of: 4 * layout.width)
    let (component, width) = (layout.component, layout.width)
    var numbers: [Float] = []
    numbers.reserveCapacity(layout.count * width)
    layout.bytes.withUnsafeBytes { buffer in
      for index in 0..<layout.count {
        for part in 0..<width {
          let offset = index * layout.stride + part * component.size
          let number = component.number(buffer, offset) * scale
          numbers.append(layout.isNormalized ? max(number, -1) : number)
        }
      }
    }
    return (numbers, width)
  }

  /// The vectors of an accessor of three components.
  mutating func vectors3(_ accessor: Int) throws -> [SIMD3<Float>] {
    let (n, width) = try vectors(accessor)
    guard width == 3 else { throw FormatFault("its accessor \(accessor) is not a VEC3") }
    return stride(from: 0, to: n.count, by: 3).map { SIMD3(n[$0], n[$0 + 1], n[$0 + 2]) }
  }

  /// The vectors of an accessor of two components.
  mutating func vectors2(_ accessor: Int) throws -> [SIMD2<Float>] {
    let (n, width) = try vectors(accessor)
    guard width == 2 else { throw FormatFault("its accessor \(accessor) is not a VEC2") }
    return stride(from: 0, to: n.count, by: 2).map { SIMD2(n[$0], n[$0 + 1]) }
  }

  /// The vertex indices of an accessor.
  mutating func indices(_ accessor: Int) throws -> [UInt32] {
    let layout = try layout(accessor)
    guard layout.width == 1 else { throw FormatFault("its indices are not scalars") }
    try budget.spend(layout.count, of: 4)
    return try layout.bytes.withUnsafeBytes { buffer in
      try (0..<layout.count).map { index in
        let offset = index * layout.stride
        switch layout.component {
        case .unsignedByte: return UInt32(buffer[offset])
        case .unsignedShort:
          return UInt32(buffer.loadUnaligned(fromByteOffset: offset, as: UInt16.self))
        case .unsignedInt: return buffer.loadUnaligned(fromByteOffset: offset, as: UInt32.self)
        default: throw FormatFault("its indices are not unsigned integers")
        }
      }
    }
  }

  private mutating func layout(_ index: Int) throws -> Layout {
    let accessor = try Self.element(content.accessors, index, "accessor")
    guard accessor.sparse == nil, let viewIndex = accessor.bufferView else {
      throw UnsupportedFeature(
        reason: "it has sparse accessors", remedy: "Export it without morph targets.")
    }
    let widths = ["SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4]
    guard let component = Component(rawValue: accessor.componentType),
      let width = widths[accessor.type]
    else { throw FormatFault("its accessor \(index) has an unknown type") }
    let view = try Self.element(content.bufferViews, viewIndex, "buffer view")
    let bytes = try self.view(viewIndex)
    let size = component.size * width
    let compressed = view.extensions?.meshopt
    let step = view.byteStride ?? compressed?.byteStride ?? size
    let start = accessor.byteOffset ?? 0
    let layout = Layout(
      bytes: bytes.dropFirst(max(0, start)), component: component,
      isNormalized: accessor.normalized ?? false, count: accessor.count, width: width,
      stride: step)
    let (last, overflow) = max(0, accessor.count - 1).multipliedReportingOverflow(by: step)
    guard start >= 0, step >= size, accessor.count >= 0, !overflow,
      accessor.count == 0 || last <= layout.bytes.count - size
    else { throw FormatFault("its accessor \(index) ends after its buffer view") }
    return layout
  }
}
