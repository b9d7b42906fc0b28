import Kernels

/// Entries of each triangle of a mesh, for instance one per photo that sees it.
///
/// Stored in blocks of consecutive triangles: threads work on several blocks at a time, and the
/// memory of a block is freed as soon as its entries have been consumed.
struct FaceEntries<Entry: Sendable>: Sendable {
  /// The entries of consecutive triangles.
  struct Block: Sendable {
    /// Entries of the block's triangle i: `entries[offsets[i]..<offsets[i + 1]]`.
    private(set) var offsets: [Int32]
    var entries: [Entry]

    var faceCount: Int { offsets.count - 1 }

    /// `face` counts from the first triangle of the block.
    func range(of face: Int) -> Range<Int> { Int(offsets[face])..<Int(offsets[face + 1]) }
  }

  /// The place of an entry.
  struct Index: Hashable, Sendable {
    var block: Int32
    /// Counts from the first entry of the block.
    var entry: Int32
  }

  private(set) var blocks: [Block]

  init(blocks: [Block]) { self.blocks = blocks }

  var faceCount: Int {
    guard let last = blocks.last else { return 0 }
    return (blocks.count - 1) * FaceBlocks.size + last.faceCount
  }

  /// The entries of a triangle.
  func entries(of face: Int) -> ArraySlice<Entry> {
    let block = blocks[face / FaceBlocks.size]
    return block.entries[block.range(of: face % FaceBlocks.size)]
  }

  subscript(index: Index) -> Entry { blocks[Int(index.block)].entries[Int(index.entry)] }

  /// Changes each block in place; `body` also gets its index.
  mutating func updateBlocks(
    _ control: KernelControl, _ body: @escaping @Sendable (Int, inout Block) -> Void
  ) throws {
    blocks = try drainBlocks(control) { index, block in
      body(index, &block)
      return block
    }
  }

  /// Maps the blocks, which leaves none.
  mutating func drainBlocks<Value: Sendable>(
    _ control: KernelControl, _ body: @escaping @Sendable (Int, inout Block) throws -> Value
  ) throws -> [Value] {
    try control.parallelMap(draining: &blocks, body)
  }
}

extension FaceEntries.Block {
  /// `counts` holds the number of entries of each triangle.
  init(counts: some Sequence<Int>, entries: [Entry]) {
    offsets = [0]
    for count in counts { offsets.append(offsets[offsets.count - 1] + Int32(count)) }
    self.entries = entries
  }

  /// Keeps the entries that satisfy the predicate, which also gets their indices.
  mutating func filter(_ isIncluded: (Int, Entry) -> Bool) {
    var (start, count) = (0, 0)
    for face in 0..<faceCount {
      let end = Int(offsets[face + 1])
      for index in start..<end where isIncluded(index, entries[index]) {
        entries[count] = entries[index]
        count += 1
      }
      start = end
      offsets[face + 1] = Int32(count)
    }
    entries.removeLast(entries.count - count)
    // If little is left, a copy takes less memory.
    if count < entries.capacity / 2 { entries = entries.map { $0 } }
  }
}
