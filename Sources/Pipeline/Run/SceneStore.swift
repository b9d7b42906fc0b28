import Kernels

/// A scene as a part of a run stores it for later ones.
struct SceneStore: Sendable {
  let units: UnitStore
  /// The fingerprint of everything that the scene and the views of its dense stage depend on.
  let inputs: UInt64

  /// Stores a scene and the views of its dense stage. Throws `OutputError`.
  func save(_ scene: ObjectScene, _ views: DenseViews) throws {
    let points = views.points.map { $0 ?? [] }
    for file in ViewPoints.files(of: views.indices) {
      let own = ViewPoints.views(of: file, count: points.count)
      try units.save(ViewPoints(Array(points[own])), .viewPoints, madeFrom: key(file))
    }
    try units.save(SceneRecord(scene, views), .scene, madeFrom: inputs)
  }

  /// The scene of some photos, without sparse points and surroundings, and the views of its dense
  /// stage; those of `block` with points. Nil if the scene was not stored.
  func scene(
    of photos: PhotoSet, withPointsOf block: Block? = nil
  ) -> (scene: ObjectScene, views: DenseViews)? {
    guard let record: SceneRecord = units.find(.scene, madeFrom: inputs),
      let scene = record.scene(of: photos)
    else { return nil }
    var views = record.views
    let count = views.points.count
    for file in block.map({ ViewPoints.files(of: $0.range(of: count)) }) ?? 0..<0 {
      let stored: ViewPoints? = units.find(.viewPoints, madeFrom: key(file))
      let own = ViewPoints.views(of: file, count: count)
      guard let points = stored?.points, points.count == own.count else { continue }
      for (view, points) in zip(own, points) { views.points[view] = points }
    }
    return (scene, views)
  }

  /// The samples of the scene that were stored; nil if there are none.
  var samples: SampleRecord? { units.find(.sceneSamples, madeFrom: inputs) }

  /// Stores what the surface of the scene is made from. Throws `OutputError`.
  func save(_ samples: SampleRecord) throws {
    try units.save(samples, .sceneSamples, madeFrom: inputs)
  }

  private func key(_ file: Int) -> UInt64 {
    var key = Fingerprint()
    key.add(inputs)
    key.add(file)
    return key.value
  }
}
