import Combine

/// Records what a publisher delivers and requests as many values as the test specifies.
final class RecordingSubscriber<Input, Failure: Error>: Subscriber {
  private(set) var values: [Input] = []
  private(set) var completions: [Subscribers.Completion<Failure>] = []
  private(set) var subscription: (any Subscription)?
  private let initialDemand: Subscribers.Demand
  private let additionalDemand: (Input) -> Subscribers.Demand

  /// Requests `initialDemand` on subscription and `additionalDemand` after each value.
  init(
    _ initialDemand: Subscribers.Demand,
    additionalDemand: @escaping (Input) -> Subscribers.Demand = { _ in .none }
  ) {
    self.initialDemand = initialDemand
    self.additionalDemand = additionalDemand
  }

  func receive(subscription: any Subscription) {
    self.subscription = subscription
    if initialDemand > .none { subscription.request(initialDemand) }
  }

  func receive(_ input: Input) -> Subscribers.Demand {
    values.append(input)
    return additionalDemand(input)
  }

  func receive(completion: Subscribers.Completion<Failure>) { completions.append(completion) }
}

/// A failure with an identity.
struct SampleError: Error, Equatable { var code: Int }
