import ArgumentParser
import Pipeline

/// A name of `ChosenUp`.
struct UpArgument: ExpressibleByArgument {
  static let allValueStrings = ChosenUp.names

  let direction: ChosenUp

  init?(argument: String) {
    guard let direction = ChosenUp(name: argument) else { return nil }
    self.direction = direction
  }
}
