import Foundation
import Logging
import Pipeline
import SharedCommands

/// A run as chunks: parts of the stages, made on a cluster or by other schedulers.
struct ChunkedRun {
  /// The photos, or views, of a chunk: so few that little is lost with a machine, so many that most
  /// sources of a view are in the same chunk. Chosen.
  private static let usualPhotosPerChunk = 32
  /// What dividing work among machines costs for each of its stages, in seconds. Chosen: a
  /// scheduler takes about as long to start the next stage.
  private static let secondsPerStage = 1.0
  /// Chunks of the photos for one of the pairs: a photo has about forty partners, and matching a
  /// pair takes a hundredth of the time of a photo's features. Chosen.
  private static let chunksPerMatchChunk = 2
  /// Chunks of the tiles for one of many photos. Chosen: about one for each tile, of which the town
  /// of 1000 photos has 66 at reduced, since nodes wait for the last chunk.
  private static let tileChunksPerChunk = 2
  /// Memory per photo of the chunks that hold the features of all photos, or the whole cloud.
  /// Measured: 2.4 GB for 1000 photos of synthetic features, with a reserve for real ones.
  private static let bytesPerPhoto = 6 << 20

  private let arguments: ReconstructArguments<PipelineArguments>
  private let photos: URL
  private let output: ModelOutput
  private let count: Int
  private let input: String
  private let threads: Int
  private let durations: StageDurationModel
  private let url: URL

  /// Throws a `CommandFailure` if the input can't be shared.
  init(
    _ arguments: ReconstructArguments<PipelineArguments>, photos: URL, output: ModelOutput
  ) throws {
    guard URL(fileURLWithPath: arguments.inputFolder).isExistingFolder else {
      throw CommandFailure.usage(
        "A video can't be divided among machines. Make photos of it with 'photogrammetry-cli "
          + "frames', and name their folder.")
    }
    (self.arguments, self.photos, self.output) = (arguments, photos, output)
    let files = try PhotoFolder.files(in: photos)
    (count, input) = (files.count, InputFingerprint.text(of: files, options: []))
    threads = arguments.engine.runArguments.threading.threads ?? Chunk.usualThreads
    durations = StageDurationModel(
      photos: PhotoTotals(count: count), finest: arguments.detail.limits, threadCount: threads,
      masksObject: !arguments.noObjectMasking, makesTiles: arguments.engine.tiles.tiles != nil)
    let name = output.url.lastPathComponent + ".plan"
    url =
      arguments.engine.slurm.planFolder.map { URL(fileURLWithPath: $0, isDirectory: true) }
      ?? output.url.absoluteURL.deletingLastPathComponent()
      .appendingPathComponent(name, isDirectory: true)
  }

  /// Writes the plan, and follows it on Slurm.
  func run(_ reporter: RunReporter) async throws {
    let slurm = arguments.engine.slurm
    try slurm.check()
    if slurm.slurm, let run = try SlurmRun.inProgress(url) {
      Logger(label: "photogrammetry-cli").info("The jobs of an earlier call are not finished yet.")
      return try await follow(run, reporter)
    }
    let folder = try PlanFolder(writing: plan, to: url.standardizedFileURL)
    guard slurm.slurm else { return folder.describe() }
    let settings = try SlurmSettings(slurm, retries: SlurmSettings.usualRetries)
    try await follow(try SlurmRun(folder, settings: settings), reporter)
  }

  private func follow(_ run: SlurmRun, _ reporter: RunReporter) async throws {
    _ = try await SlurmWatch(run: run, style: reporter.style).follow()
    try run.folder.conclude(reporter)
  }

  // MARK: - Plan

  private var plan: ChunkPlan {
    let size = arguments.engine.photosPerChunk ?? Self.usualPhotosPerChunk
    let blocks = max(1, (count + size - 1) / size)
    return ChunkPlan(
      stages: alignmentStages(blocks) + denseStages(blocks)
        + (hasTiles ? tileStages(blocks) : [ChunkStage(name: "model", chunks: [model])]))
  }

  /// The steps of the dense stage; one chunk makes all of them if little time is saved otherwise.
  private func denseStages(_ blocks: Int) -> [ChunkStage] {
    let (parts, seconds) = (DensePart.allCases, durations.seconds(of: [.pointCloudGeneration]))
    guard isWorthDividing(seconds, among: blocks, stages: parts.count) else {
      return [stage(DensePart.cloud.rawValue, blocks: 1, seconds: seconds)]
    }
    return parts.map { stage($0.rawValue, blocks: blocks, seconds: $0.cost * seconds) }
  }

  /// Whether dividing work of `seconds` in each of several stages saves more time than it costs;
  /// always if the number of photos per chunk is given.
  private func isWorthDividing(_ seconds: Double, among blocks: Int, stages: Int = 1) -> Bool {
    guard blocks > 1, arguments.engine.photosPerChunk == nil else { return blocks > 1 }
    let saved = seconds * (1 - 1 / Double(blocks))
    return saved > Double(stages) * Self.secondsPerStage
  }

  /// Whether pairs are matched in chunks of their own, in five stages more.
  private func dividesMatches(_ blocks: Int) -> Bool {
    let shares = AlignmentShares.self
    return isWorthDividing(
      (shares.pairs + shares.matches + shares.moreMatches)
        * durations.seconds(of: [.imageAlignment]),
      among: blocks / Self.chunksPerMatchChunk, stages: 5)
  }

  /// The chunk of the model, which makes its surface, too, unless a chunk before it did.
  private var model: Chunk {
    var stages: [PipelineStage] = [.textureMapping, .optimization]
    if !hasTiles { stages.append(.meshGeneration) }
    return chunk(
      "model", part: hasTiles ? "model" : nil, seconds: withoutTiles.seconds(of: stages),
      holdsAll: true)
  }

  /// Shares of the time of alignment.
  private enum AlignmentShares {
    /// Measured: in chunks of 250 photos of a town.
    static let (features, candidates, pairs, matches) = (0.15, 0.01, 0.03, 0.3)
    /// Measured: as above.
    static let (morePairs, moreMatches, cameras) = (0.03, 0.17, 0.32)
    /// That of features among few photos, which have few pairs. Measured: in runs of 11, 32 and 40
    /// photos.
    static let featuresOfFew = 0.4
  }

  /// The stages up to the cameras. The chunk of the cameras makes matches and features, too, if
  /// little time is saved otherwise.
  private func alignmentStages(_ blocks: Int) -> [ChunkStage] {
    let (seconds, shares) = (durations.seconds(of: [.imageAlignment]), AlignmentShares.self)
    let masks = durations.seconds(of: [.objectMasking])
    func cameras(share: Double) -> ChunkStage {
      stage("cameras", seconds: share * seconds + masks, holdsAll: true)
    }
    let photos = photoStages(blocks)
    guard dividesMatches(blocks) else {
      let ofFeatures = shares.featuresOfFew * seconds
      return isWorthDividing(ofFeatures, among: blocks)
        ? photos + [
          stage("features", blocks: blocks, seconds: ofFeatures),
          cameras(share: 1 - shares.featuresOfFew),
        ] : photos + [cameras(share: 1)]
    }
    let matchBlocks = blocks / Self.chunksPerMatchChunk
    return photos + [
      stage("features", blocks: blocks, seconds: shares.features * seconds),
      stage("candidates", seconds: shares.candidates * seconds, holdsAll: true),
      stage("pairs", blocks: matchBlocks, seconds: shares.pairs * seconds),
      stage("matches", blocks: matchBlocks, seconds: shares.matches * seconds),
      stage("morePairs", seconds: shares.morePairs * seconds, holdsAll: true),
      stage("moreMatches", blocks: matchBlocks, seconds: shares.moreMatches * seconds),
      cameras(share: shares.cameras),
    ]
  }

  /// The list of usable photos, and before it the inspection of the files if that takes long.
  private func photoStages(_ blocks: Int) -> [ChunkStage] {
    let seconds = durations.seconds(of: [.preProcessing])
    let inspectionBlocks = blocks / Self.chunksPerMatchChunk
    guard isWorthDividing(seconds, among: inspectionBlocks) else {
      return [stage("photos", seconds: seconds)]
    }
    return [
      stage("inspections", blocks: inspectionBlocks, seconds: seconds),
      stage("photos", seconds: Self.secondsPerStage),
    ]
  }

  private var hasTiles: Bool { durations.makesTiles }

  private var withoutTiles: StageDurationModel {
    var result = durations
    result.makesTiles = false
    return result
  }

  /// The stages that make tiles. Beside their surfaces that of the scene is made, which hides tiles
  /// from photos, and beside the tiles the model.
  private func tileStages(_ blocks: Int) -> [ChunkStage] {
    let seconds =
      durations.seconds(of: [.optimization]) - withoutTiles.seconds(of: [.optimization])
    let surface = durations.seconds(of: [.meshGeneration]) / 2
    let tileBlocks = dividesMatches(blocks) ? Self.tileChunksPerChunk * blocks : blocks
    func tiles(_ part: TilePart, beside other: Chunk) -> ChunkStage {
      var result = stage(
        part.rawValue, blocks: tileBlocks, seconds: part.cost * seconds, holdsAll: true)
      // The longest chunk begins first.
      result.chunks.insert(other, at: 0)
      return result
    }
    return [
      stage("tileBase", seconds: surface, holdsAll: true),
      tiles(
        .tileSurfaces,
        beside: chunk("surface", part: "surface", seconds: surface, holdsAll: true)),
      tiles(.tiles, beside: model),
      stage("tileIndex", seconds: 1),
    ]
  }

  /// A stage of `blocks` chunks, which take `seconds` together; of a single chunk without a number
  /// of blocks.
  private func stage(
    _ name: String, blocks: Int? = nil, seconds: Double, holdsAll: Bool = false
  ) -> ChunkStage {
    guard let blocks else {
      return ChunkStage(
        name: name, chunks: [chunk(name, part: name, seconds: seconds, holdsAll: holdsAll)])
    }
    return ChunkStage(
      name: name,
      chunks: (1...blocks).map { number in
        chunk(
          "\(name) \(number) of \(blocks)", part: "\(name):\(number)/\(blocks)",
          seconds: seconds / Double(blocks), holdsAll: holdsAll)
      })
  }

  private func chunk(
    _ name: String, part: String?, seconds: Double, holdsAll: Bool
  ) -> Chunk {
    let work =
      arguments.checkpointDirectory.map { URL(fileURLWithPath: $0).standardizedFileURL.path }
      ?? url.appendingPathComponent("work").standardizedFileURL.path
    let isKept = arguments.checkpointDirectory != nil
    let words =
      PlannedArguments.shared(CommandLine.arguments) + MachineLimits.arguments(photos: count)
      + ["--json", "--until-input-ends", "--checkpoint-directory", work]
      + (part.map { ["--part", $0] } ?? [])
    let memory = arguments.detail.detail.expectedMemoryBytes + Chunk.spareMemory
    let isLast = part == nil || part == "tileIndex"
    return Chunk(
      name: name, arguments: words, directory: FileManager.default.currentDirectoryPath,
      reads: [photos.standardizedFileURL.path, work],
      writes: files(of: part) ?? [work] + (writesTiles(part) ? tileFolder : []),
      areSealed: files(of: part) == nil, scratch: isLast && !isKept ? work : nil,
      fingerprint: InputFingerprint.text(of: [], options: words + [input]),
      expectedSeconds: seconds, threads: threads,
      memoryBytes: memory + (holdsAll ? count * Self.bytesPerPhoto : 0))
  }

  /// What a part makes for the user; nil if only other parts need its files.
  private func files(of part: String?) -> [String]? {
    switch part {
    case nil, "model": results
    case "tileIndex": tileFolder
    default: nil
    }
  }

  private func writesTiles(_ part: String?) -> Bool {
    part?.hasPrefix(TilePart.tiles.rawValue + ":") == true
  }

  private var tileFolder: [String] {
    arguments.engine.tiles.tiles.map { [URL(fileURLWithPath: $0).standardizedFileURL.path] } ?? []
  }

  /// The paths of the files that the run writes, without tiles.
  private var results: [String] {
    let coarser = (try? CoarserModel.all(arguments.detail, nextTo: output)) ?? []
    let companions = [
      arguments.poses, arguments.pointCloud, arguments.engine.preview.preview,
      arguments.engine.runArguments.report,
    ].compactMap(\.self).map { URL(fileURLWithPath: $0) }
    return ([output.url] + coarser.map(\.output.url) + companions).map(\.standardizedFileURL.path)
  }
}
