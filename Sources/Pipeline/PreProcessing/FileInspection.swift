import Foundation
import Kernels
import SceneModel

/// Inspects the files of a folder, each by itself.
struct FileInspection: Sendable {
  let files: [URL]
  private let masks: MaskFiles
  private let companions: RawCompanions
  private let inspection: PhotoInspection

  init(_ files: [URL], _ masks: MaskFiles, _ options: PhotoInspection.Options) {
    (self.files, self.masks) = (files, masks)
    (companions, inspection) = (RawCompanions(files), PhotoInspection(options))
  }

  /// Inspects some of the files. Throws only on cancellation.
  func run(_ range: Range<Int>, _ control: KernelControl) throws -> InspectionBlock {
    InspectionBlock(
      results: try control.parallelMap(range.count) { try result(range.lowerBound + $0) })
  }

  /// Inspects a file; the index of a file is its sample ID.
  private func result(_ sampleID: Int) throws -> Result<InspectedPhoto, Rejection> {
    let (file, name) = (files[sampleID], files[sampleID].lastPathComponent)
    func rejection(_ fault: RejectedPhoto.Fault, _ end: String) -> Rejection {
      Rejection(RejectedPhoto(sampleID: sampleID, name: name, fault: fault, end: end))
    }
    do {
      if let photo = companions.photo(insteadOf: file, inspection) {
        return .failure(
          rejection(.duplicate, "it is the raw file of \(photo.lastPathComponent), which is used"))
      }
      return .success(try inspection.run(file, sampleID: sampleID, mask: masks.mask(of: file)))
    } catch let rejection as Rejection {
      return .failure(rejection)
    } catch let error as CancellationError {
      throw error
    } catch {
      return .failure(rejection(.unreadable, "\(error)"))
    }
  }
}
