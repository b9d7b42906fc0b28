/// The kind of object at a path of the layer.
enum CrateSpecType: Int32 {
  case attribute = 1
  case prim = 6
  case pseudoRoot = 7
  case relationship = 8
}
