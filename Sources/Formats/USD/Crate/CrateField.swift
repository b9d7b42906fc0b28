/// A name-value pair of a spec, by indices.
struct CrateField: Hashable {
  var token: UInt32
  var value: CrateValueRep
}
