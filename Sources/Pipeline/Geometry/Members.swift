import Kernels

/// The elements of each group, ascending, in compressed-row storage (one array with offsets).
struct Members: Sendable {
  private var offsets: [Int32]
  private var elements: [Int32]

  /// The points of the cells of a grid, which has found its members.
  init(of grid: VoxelGrid) { (offsets, elements) = (grid.starts, grid.members) }

  /// `groups` holds each element's group, in 0..<`count`; −1 means none.
  init(of groups: [Int32], count: Int) {
    offsets = Array(repeating: 0, count: count + 1)
    for group in groups where group >= 0 { offsets[Int(group) + 1] += 1 }
    for group in 0..<count { offsets[group + 1] += offsets[group] }
    var cursor = offsets
    elements = Array(repeating: 0, count: Int(offsets[count]))
    for (element, group) in groups.enumerated() where group >= 0 {
      elements[Int(cursor[Int(group)])] = Int32(element)
      cursor[Int(group)] += 1
    }
  }

  /// The elements of a group.
  subscript(group: Int) -> ArraySlice<Int32> { elements[places(of: group)] }

  /// Where the elements of a group are: unlike a slice, it holds no reference, which threads would
  /// count one after the other.
  func places(of group: Int) -> Range<Int> {
    Int(offsets[group])..<Int(offsets[group + 1])
  }

  /// The element at a place.
  subscript(at place: Int) -> Int { Int(elements[place]) }
}
