/// One row of an element; scalars and lists are indexed by property.
struct PLYRow {
  var scalars: [Double]
  var lists: [[Double]]
}
