import SceneModel

/// The rejection of a file, as an error.
struct Rejection: Error {
  var photo: RejectedPhoto

  init(_ photo: RejectedPhoto) { self.photo = photo }
}
