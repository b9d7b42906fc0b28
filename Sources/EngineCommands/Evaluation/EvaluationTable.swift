import Evaluation
import Foundation

/// The results of an evaluation as rows of names and values.
struct EvaluationTable {
  private(set) var rows: [(name: String, value: String)] = []
  private let metersPerUnit: Double?

  init(_ report: EvaluationReport) {
    metersPerUnit = report.metersPerUnit
    report.poses.map { add($0) }
    report.reprojection.map { add($0) }
    if let triangles = report.triangles { rows.append(("triangles", "\(triangles)")) }
    report.mesh.map { add("mesh", $0) }
    report.cloud.map { addCloud("cloud", $0) }
    report.averagedCloud.map { addCloud("averaged", $0) }
    report.density.map { add($0) }
    report.heldOut.map { add($0) }
    report.outline.map { add($0) }
    report.run.map { add($0) }
  }

  /// Lines with aligned values.
  var text: String {
    let width = rows.map(\.name.count).max() ?? 0
    return rows.map { name, value in
      name.padding(toLength: width + 2, withPad: " ", startingAt: 0) + value
    }.joined(separator: "\n")
  }

  var markdown: String {
    (["| | |", "|---|---|"] + rows.map { "| \($0.name) | \($0.value) |" })
      .joined(separator: "\n")
  }

  private mutating func add(_ poses: PoseErrors) {
    rows += [
      ("registered", "\(poses.registered) of \(poses.total)"),
      ("center RMSE", length(poses.centerRMSE)), ("center median", length(poses.centerMedian)),
      ("center maximum", length(poses.centerMaximum)),
      ("rotation mean", "\(decimals(poses.rotationMeanDegrees, 4)) deg"),
      ("rotation maximum", "\(decimals(poses.rotationMaximumDegrees, 4)) deg"),
    ]
    rows += poses.areaUnderCurve.map {
      ("AUC at \(plain($0.thresholdDegrees)) deg", decimals($0.value, 4))
    }
  }

  private mutating func add(_ reprojection: ReprojectionStatistics) {
    rows += [
      ("points", "\(reprojection.points)"), ("observations", "\(reprojection.observations)"),
      ("track length", decimals(reprojection.meanTrackLength, 2)),
      ("reprojection mean", "\(decimals(reprojection.meanPixels, 3)) px"),
      ("reprojection mean of points", "\(decimals(reprojection.meanOfPointsPixels, 3)) px"),
      ("reprojection median", "\(decimals(reprojection.medianPixels, 3)) px"),
    ]
  }

  private mutating func add(_ name: String, _ scores: SurfaceScores) {
    for at in scores.thresholds {
      let place = "at \(plainLength(at.threshold))"
      rows += [
        ("\(name) precision \(place)", decimals(at.precision, 4)),
        ("\(name) recall \(place)", decimals(at.recall, 4)),
        ("\(name) F-score \(place)", decimals(at.fScore, 4)),
      ]
    }
    rows += [
      ("\(name) accuracy", length(scores.accuracy)),
      ("\(name) completeness", length(scores.completeness)),
      ("\(name) Chamfer", length(scores.chamfer)),
    ]
  }

  private mutating func addCloud(_ name: String, _ scores: SurfaceScores) {
    rows.append(("\(name) points", "\(scores.resultSamples)"))
    add(name, scores)
  }

  private mutating func add(_ density: CloudDensity) {
    if let sparse = density.sparsePoints, sparse > 0 {
      let ratio = Double(density.points) / Double(sparse)
      rows.append(("dense per sparse point", decimals(ratio, 1)))
    }
    let unit = metersPerUnit ?? 1
    rows.append(
      (
        metersPerUnit == nil ? "points per cubic unit" : "points per cubic meter",
        String(format: "%.4g", density.pointsPerCubicUnit / (unit * unit * unit))
      ))
  }

  private mutating func add(_ photos: PhotoScoreSummary) {
    rows += [
      ("held-out photos", "\(photos.photos.count)"), ("PSNR", "\(decimals(photos.psnr, 2)) dB"),
      ("SSIM", decimals(photos.ssim, 4)),
    ]
  }

  private mutating func add(_ outline: OutlineScores) {
    rows += [
      ("photos with a mask", "\(outline.photos.count)"),
      ("outline IoU mean", decimals(outline.intersectionOverUnion, 4)),
      (
        "outline IoU minimum",
        "\(decimals(outline.minimumIntersectionOverUnion, 4)) (\(outline.worst))"
      ),
      ("outside of masks", "\(decimals(100 * outline.outside, 2)) %"),
      ("missing in masks", "\(decimals(100 * outline.missing, 2)) %"),
    ]
  }

  private mutating func add(_ run: RunFigures) {
    rows += [
      ("run", "\(decimals(run.seconds, 1)) s, \(decimals(run.cpuSeconds, 1)) CPU s"),
      ("seconds per photo", decimals(run.secondsPerPhoto, 2)),
      ("peak memory", "\(decimals(Double(run.peakMemoryBytes) / 1e9, 2)) GB"),
    ]
  }

  private func length(_ value: Double) -> String {
    metersPerUnit.map { "\(decimals(value * $0 * 1000, 4)) mm" } ?? decimals(value, 6)
  }

  private func plainLength(_ value: Double) -> String {
    metersPerUnit.map { "\(plain(value * $0 * 1000)) mm" } ?? plain(value)
  }

  private func decimals(_ value: Double, _ count: Int) -> String {
    String(format: "%.\(count)f", value)
  }

  private func plain(_ value: Double) -> String { String(format: "%g", value) }
}
