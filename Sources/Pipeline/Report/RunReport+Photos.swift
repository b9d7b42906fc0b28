import SceneModel

// What is known about photos before they are aligned.

extension RunReport {
  /// The report of photos that were read, and matched if `matches` is given, but not aligned.
  package init(
    _ ingested: IngestedPhotos, _ matches: MatchRecord?, configuration: PipelineConfiguration
  ) {
    self.init(configuration: configuration)
    add(ingested)
    photos.sort { $0.name < $1.name }
    warnings = ingested.rejectedMasks.map(\.reason)
    if let matches { add(matches, of: ingested.photos.map(\.name)) }
  }

  /// Adds the photos of a folder.
  mutating func add(_ ingested: IngestedPhotos) {
    photos += ingested.rejected.map(PhotoEntry.init) + ingested.photos.map(PhotoEntry.init)
  }

  /// Adds which photos match; `names` are those of the photos, by ID.
  mutating func add(_ matches: MatchRecord, of names: [String]) {
    guard matches.features.count == names.count else { return }
    self.matches = .init(photos: names, pairs: matches)
    let partners = matches.partners
    var groupOfPhoto = [Int](repeating: 0, count: names.count)
    for (number, group) in matches.groups.enumerated() {
      for photo in group { groupOfPhoto[photo] = number }
    }
    update(names) { photo, entry in
      entry.features = matches.features[photo]
      entry.partners = partners[photo]
      entry.group = groupOfPhoto[photo]
    }
  }

  /// Changes the entries of photos; `change` receives the index of each name.
  mutating func update(_ names: [String], _ change: (Int, inout PhotoEntry) -> Void) {
    let entries = Dictionary(
      zip(photos.map(\.name), photos.indices), uniquingKeysWith: { first, _ in first })
    for (index, name) in names.enumerated() {
      if let entry = entries[name] { change(index, &photos[entry]) }
    }
  }
}

extension RunReport.PhotoEntry {
  /// A photo without a pose yet.
  fileprivate init(_ photo: Photo) {
    self.init(name: photo.name, status: .notRegistered)
    (width, height) = (photo.width, photo.height)
    sharpness = photo.detail(at: photo.width * photo.height)
    maskShare = photo.mask?.coverage
  }

  fileprivate init(_ photo: RejectedPhoto) {
    self.init(name: photo.name, status: .rejected, reason: photo.reason)
    fault = photo.fault
  }
}
