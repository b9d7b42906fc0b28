extension PointCloudGeneration {
  /// Every `count`-th view, starting at `index`: the part of one of several jobs.
  package struct Share: Hashable, Sendable {
    package var index: Int
    package var count: Int

    /// `index` is in 0..<`count`.
    package init(index: Int, of count: Int) {
      self.index = index
      self.count = count
    }

    func contains(_ position: Int) -> Bool { position % count == index }
  }
}
