import Foundation

/// The part of JSON Schema (2020-12) that `docs/report.schema.json` uses.
package struct JSONSchema {
  private let root: [String: Any]

  package init(_ file: URL) throws {
    let json = try JSONSerialization.jsonObject(with: Data(contentsOf: file))
    root = json as? [String: Any] ?? [:]
  }

  /// What is wrong with a document, each fault with its place.
  package func faults(in document: Data) throws -> [String] {
    faults(in: try JSONSerialization.jsonObject(with: document), root, at: "$")
  }

  private func faults(in value: Any, _ schema: [String: Any], at path: String) -> [String] {
    if let values = schema["enum"] as? [String] {
      return values.contains { $0 == value as? String } ? [] : ["\(path): \(value)"]
    }
    switch schema["type"] as? String {
    case "string": return value is String ? [] : ["\(path) is no string"]
    case "number", "integer": return faults(inNumber: value, schema, at: path)
    case "array": return faults(inArray: value, schema, at: path)
    case "object": return faults(inObject: value, schema, at: path)
    case let type: return ["\(path): the schema has the type \(type ?? "none")"]
    }
  }

  private func faults(inNumber value: Any, _ schema: [String: Any], at path: String) -> [String] {
    guard let number = (value as? NSNumber)?.doubleValue, !(value is String) else {
      return ["\(path) is no number"]
    }
    let isWhole = schema["type"] as? String != "integer" || number.rounded() == number
    let low = (schema["minimum"] as? NSNumber)?.doubleValue ?? -.infinity
    let high = (schema["maximum"] as? NSNumber)?.doubleValue ?? .infinity
    return isWhole && number >= low && number <= high ? [] : ["\(path): \(number)"]
  }

  private func faults(inArray value: Any, _ schema: [String: Any], at path: String) -> [String] {
    guard let array = value as? [Any] else { return ["\(path) is no array"] }
    let low = schema["minItems"] as? Int ?? 0
    let high = schema["maxItems"] as? Int ?? .max
    let items = schema["items"] as? [String: Any] ?? [:]
    return (array.count < low || array.count > high ? ["\(path) has \(array.count) items"] : [])
      + array.enumerated().flatMap { faults(in: $1, items, at: "\(path)[\($0)]") }
  }

  private func faults(inObject value: Any, _ schema: [String: Any], at path: String) -> [String] {
    guard let object = value as? [String: Any] else { return ["\(path) is no object"] }
    let properties = schema["properties"] as? [String: [String: Any]] ?? [:]
    let required = schema["required"] as? [String] ?? []
    let missing = required.filter { object[$0] == nil }.map { "\(path).\($0) is missing" }
    return missing
      + object.sorted { $0.key < $1.key }.flatMap { name, member -> [String] in
        if let schema = properties[name] {
          return faults(in: member, schema, at: "\(path).\(name)")
        }
        if let schema = schema["additionalProperties"] as? [String: Any] {
          return faults(in: member, schema, at: "\(path).\(name)")
        }
        return schema["additionalProperties"] as? Bool == false
          ? ["\(path).\(name) is not in the schema"] : []
      }
  }
}
