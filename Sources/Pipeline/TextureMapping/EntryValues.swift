/// A value for each entry of `FaceEntries`.
struct EntryValues<Value: Sendable>: Sendable {
  /// By block, then in the order of the block's entries.
  var blocks: [[Value]]

  init(blocks: [[Value]]) { self.blocks = blocks }

  /// The same value for all entries.
  init<Entry>(repeating value: Value, for entries: FaceEntries<Entry>) {
    blocks = entries.blocks.map { Array(repeating: value, count: $0.entries.count) }
  }

  subscript<Entry>(index: FaceEntries<Entry>.Index) -> Value {
    get { blocks[Int(index.block)][Int(index.entry)] }
    set { blocks[Int(index.block)][Int(index.entry)] = newValue }
  }
}
