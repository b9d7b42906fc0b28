import Foundation
import SceneModel

/// Judges a run by the figures of its report.
struct ReportAssessment {
  /// The report with its verdict, and the advice that follows from its figures.
  func run(_ report: RunReport) -> RunReport {
    var result = report
    result.verdict = RunVerdict(report)
    if !report.errors.isEmpty { result.explainUnusedPhotos() }
    let onPhotos = PhotoAdvice().run(report)
    // What a surface that isn't the object's lacks is no advice.
    let isWhole = report.concerns.isEmpty && !onPhotos.contains { $0.kind == .texture }
    result.advice = onPhotos + report.advice.filter { isWhole || $0.kind != .surface }
    return result
  }
}

extension RunReport {
  /// Gives photos that were not looked at, because the run failed, a reason.
  fileprivate mutating func explainUnusedPhotos() {
    for index in photos.indices
    where photos[index].status == .notRegistered && photos[index].reason == nil {
      photos[index].reason =
        "\(photos[index].name) can be used, but the run ended before its camera was found."
    }
  }

  /// The report with its verdict and all advice.
  package var assessed: RunReport { ReportAssessment().run(self) }

  /// The report as JSON with sorted keys, with its verdict.
  package func encoded() throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    return try encoder.encode(assessed)
  }
}

extension RunVerdict {
  /// Shares of the photos that are used, below which a model is not good or even poor. Chosen:
  /// those of Pix4D's quality report.
  private static let (goodPhotos, fairPhotos) = (0.95, 0.65)
  /// The shares of the area that three photos show; the first one if it isn't known what more
  /// photos could show. Chosen: an object that stands on a table shows a fifth of its surface to no
  /// camera.
  private static let (goodArea, fairArea) = (0.7, 0.5)
  /// The largest share of the area that more photos would show. Measured: none on six complete
  /// rendered sets, 6 % and more on eight from which an arc was left out.
  private static let goodMissing = 0.05
  /// The shares of the object's outline that the model fills. Measured: see `PhotoAdvice`.
  private static let (goodOutline, fairOutline) = (0.85, 0.5)

  init(_ report: RunReport) {
    let all = report.photos.count(where: \.countsAsPhoto)
    let used = report.photos.count { $0.status == .registered }
    if let error = report.errors.first, report.surface == nil {
      self.init(level: .failed, sentence: "There is no model. \(error)")
    } else if let surface = report.surface {
      if let concern = report.concerns.last ?? report.errors.first {
        self.init(level: .poor, sentence: "The model may not be what you want. \(concern)")
      } else {
        self.init(of: surface, used: used, of: all)
      }
    } else if used > 0 {
      self.init(
        level: .unknown, sentence: "\(Self.photos(used, of: all)) to find the cameras.")
    } else {
      let usable = report.photos.count { $0.status == .notRegistered }
      let subject = usable == all ? "All \(all)" : "\(usable) of \(all)"
      self.init(level: .unknown, sentence: "\(subject) photos can be used.")
    }
  }

  /// Of a finished model.
  private init(of surface: SurfaceStatistics, used: Int, of all: Int) {
    let share = Double(used) / Double(max(1, all))
    let area = surface.share(shownBy: 3)
    let outline = surface.outlineShare ?? 1
    func percent(_ share: Double) -> String { "\(Int((share * 100).rounded())) %" }
    let isPoor =
      share < Self.fairPhotos || area < Self.fairArea || outline < Self.fairOutline
    let isCovered = surface.missingShare.map { $0 < Self.goodMissing } ?? (area >= Self.goodArea)
    let isGood = share >= Self.goodPhotos && isCovered && outline >= Self.goodOutline
    let shown =
      outline < Self.goodOutline
      ? "the model shows only \(percent(outline)) of the object"
      : "three or more photos show \(percent(area)) of the surface"
    self.init(
      level: isPoor ? .poor : isGood ? .good : .fair,
      sentence: "\(Self.photos(used, of: all))\(isGood ? ", and" : ";") \(shown).")
  }

  private static func photos(_ used: Int, of all: Int) -> String {
    used == all ? "All \(all) photos were used" : "\(used) of \(all) photos were used"
  }
}

extension RunReport.PhotoEntry {
  /// Whether the user meant it to be used: neither a copy nor another kind of file.
  fileprivate var countsAsPhoto: Bool {
    status != .missing && fault != .duplicate && fault != .unsupportedFormat
  }
}
