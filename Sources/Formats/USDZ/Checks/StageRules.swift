/// The rules for the metadata of the root layer.
struct StageRules {
  private(set) var findings: [String] = []

  init(_ layer: USDLayer, missing: [String]) {
    if layer.metadata("upAxis")?.text != "Y" { findings.append("the up axis is not Y") }
    if layer.metadata("metersPerUnit")?.number != 1 { findings.append("metersPerUnit is not 1") }
    if layer.defaultPrim.isEmpty {
      findings.append("there is no default prim")
    } else if !layer.prims.contains(where: { $0.name == layer.defaultPrim }) {
      findings.append("the default prim \(layer.defaultPrim) does not exist")
    }
    findings += missing.map { "the layer \($0) is not in the package" }
  }
}
