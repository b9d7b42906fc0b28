/// A log message: an interpolated string whose values have formats and privacy options.
public struct OSLogMessage: ExpressibleByStringInterpolation {
  /// The message with its values.
  public let interpolation: OSLogInterpolation

  /// Creates a message from an interpolation.
  public init(stringInterpolation: OSLogInterpolation) { interpolation = stringInterpolation }

  /// Creates a message from a literal.
  public init(stringLiteral value: String) {
    var interpolation = OSLogInterpolation(literalCapacity: value.utf8.count, interpolationCount: 0)
    interpolation.appendLiteral(value)
    self.interpolation = interpolation
  }
}
