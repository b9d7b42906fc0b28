/// Value types of the crate format.
enum CrateType: UInt64 {
  case bool = 1
  case int = 3
  case float = 8
  case double = 9
  case string = 10
  case token = 11
  case asset = 12
  case float2 = 20
  case float3 = 24
  case float4 = 28
  case dictionary = 31
  case tokenListOp = 32
  case pathListOp = 34
  case tokenVector = 41
  case specifier = 42
  case variability = 44
}
