import Evaluation
import Foundation

extension EvaluationReport {
  /// The report as lines of names and values.
  var table: String {
    var rows: [(String, String)] = []
    if let poses {
      rows += [
        ("registered", "\(poses.registered) of \(poses.total)"),
        ("center RMSE", Self.length(poses.centerRMSE)),
        ("center median", Self.length(poses.centerMedian)),
        ("center maximum", Self.length(poses.centerMaximum)),
        ("rotation mean", "\(Self.decimals(poses.rotationMeanDegrees, 4)) deg"),
        ("rotation maximum", "\(Self.decimals(poses.rotationMaximumDegrees, 4)) deg"),
      ]
      rows += poses.areaUnderCurve.map {
        ("AUC at \(Self.plain($0.thresholdDegrees)) deg", Self.decimals($0.value, 4))
      }
    }
    if let reprojection {
      rows += [
        ("points", "\(reprojection.points)"), ("observations", "\(reprojection.observations)"),
        ("track length", Self.decimals(reprojection.meanTrackLength, 2)),
        ("reprojection mean", "\(Self.decimals(reprojection.meanPixels, 3)) px"),
        ("reprojection median", "\(Self.decimals(reprojection.medianPixels, 3)) px"),
      ]
    }
    if let triangles { rows.append(("triangles", "\(triangles)")) }
    if let mesh { rows += Self.rows("mesh", mesh) }
    if let cloud { rows += Self.cloudRows("cloud", cloud) }
    if let averagedCloud { rows += Self.cloudRows("averaged", averagedCloud) }
    let width = rows.map(\.0.count).max() ?? 0
    return rows.map { name, value in
      name.padding(toLength: width + 2, withPad: " ", startingAt: 0) + value
    }.joined(separator: "\n")
  }

  private static func rows(_ name: String, _ scores: SurfaceScores) -> [(String, String)] {
    scores.thresholds.flatMap { at in
      let place = "at \(plain(at.threshold))"
      return [
        ("\(name) precision \(place)", decimals(at.precision, 4)),
        ("\(name) recall \(place)", decimals(at.recall, 4)),
        ("\(name) F-score \(place)", decimals(at.fScore, 4)),
      ]
    } + [("\(name) chamfer", length(scores.chamfer))]
  }

  private static func cloudRows(_ name: String, _ scores: SurfaceScores) -> [(String, String)] {
    [("\(name) points", "\(scores.resultSamples)")] + rows(name, scores)
  }

  private static func length(_ value: Double) -> String { decimals(value, 6) }

  private static func decimals(_ value: Double, _ count: Int) -> String {
    String(format: "%.\(count)f", value)
  }

  private static func plain(_ value: Double) -> String {
    String(format: "%g", value)
  }
}
