import ArgumentParser
import Pipeline

/// A share of the views, such as "2/8": the second of eight.
struct JobArgument: ExpressibleByArgument {
  let share: PointCloudGeneration.Share

  init?(argument: String) {
    let numbers = argument.split(separator: "/", omittingEmptySubsequences: false).map { Int($0) }
    guard numbers.count == 2, let number = numbers[0], let count = numbers[1], count >= 1,
      (1...count).contains(number)
    else { return nil }
    share = PointCloudGeneration.Share(index: number - 1, of: count)
  }
}
