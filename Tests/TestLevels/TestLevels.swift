import Foundation
import Testing

extension Trait where Self == ConditionTrait {
  /// Marks a suite or a test that takes seconds because it runs large parts of the pipeline or the
  /// built program. `scripts/test` runs it, `scripts/test --quick` leaves it out.
  package static var endToEnd: Self {
    .disabled(
      if: ProcessInfo.processInfo.environment["PHOTOGRAMMETRY_QUICK_TESTS"] == "1",
      "left out of quick runs")
  }
}
