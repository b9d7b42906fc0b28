import Foundation
import Kernels
import SceneModel

/// The number of bytes of all records, the records as JSON, then the pixels of each thumbnail.
extension InspectionBlock: UnitValue {
  func unitData() throws -> Data {
    let records = try Fingerprint.content(of: results.map(InspectionRecord.init))
    var data = Data(bytesOf: [UInt64(records.count)]) + records
    for case .success(let photo) in results { data += photo.thumbnail.pixels }
    return data
  }

  init?(unit: Data) {
    let start = MemoryLayout<UInt64>.size
    guard let count = unit.prefix(start).values(of: UInt64.self).first,
      count <= UInt64(unit.count - start),
      let records = try? JSONDecoder().decode(
        [InspectionRecord].self, from: unit.dropFirst(start).prefix(Int(count)))
    else { return nil }
    var pixels = unit.dropFirst(start + Int(count))
    for record in records {
      guard let result = record.result(&pixels) else { return nil }
      results.append(result)
    }
    guard pixels.isEmpty else { return nil }
  }
}

/// What was found in a file, without the pixels of the thumbnail.
private struct InspectionRecord: Codable {
  private var photo: InspectedPhoto?
  private var rejected: RejectedPhoto?
  private var thumbnailWidth = 0
  private var thumbnailHeight = 0

  init(_ result: Result<InspectedPhoto, Rejection>) {
    switch result {
    case .success(let inspected):
      photo = inspected
      (thumbnailWidth, thumbnailHeight) = (inspected.thumbnail.width, inspected.thumbnail.height)
    case .failure(let rejection): rejected = rejection.photo
    }
  }

  /// The result, with a thumbnail of the first ones of `pixels`, which are removed; nil if there
  /// are not enough.
  func result(_ pixels: inout Data) -> Result<InspectedPhoto, Rejection>? {
    if let rejected { return .failure(Rejection(rejected)) }
    guard var photo, thumbnailWidth > 0, thumbnailHeight > 0,
      thumbnailWidth <= pixels.count / thumbnailHeight
    else { return nil }
    let own = pixels.prefix(thumbnailWidth * thumbnailHeight)
    photo.thumbnail = RasterImage(
      width: thumbnailWidth, height: thumbnailHeight, channels: 1, pixels: Array(own))
    pixels = pixels.dropFirst(own.count)
    return .success(photo)
  }
}
