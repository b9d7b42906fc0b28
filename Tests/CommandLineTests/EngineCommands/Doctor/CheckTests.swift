import Kernels
import Pipeline
import RealityFoundation
import SceneModel
import SharedCommands
import Testing

@testable import EngineCommands

@Suite struct CheckTests {
  private func machine(gibibytes: Int, features: Set<String>? = nil) -> Machine {
    Machine(totalMemoryBytes: gibibytes << 30, processorFeatures: features)
  }

  @Test func versionNamesTheBuild() {
    let check = Check.version(
      of: EngineBuild(isOptimized: true), fingerprint: 0xAB, system: "Linux")
    #expect(check.status == .ok)
    #expect(check.text == "\(ProgramVersion.current), build 00000000000000ab, on Linux.")
    let slow = Check.version(of: EngineBuild(isOptimized: false), fingerprint: .max, system: "")
    #expect(slow.status == .note && slow.remedy?.contains("-c release") == true)
  }

  /// More memory never allows less.
  @Test func memoryAllowsLevels() throws {
    let statuses = (0...16).map { Check.memory(of: machine(gibibytes: $0)).status }
    #expect(statuses[0...1].allSatisfy { $0 == .problem })
    #expect(statuses[2..<8].allSatisfy { $0 == .note })
    #expect(statuses[8...].allSatisfy { $0 == .ok })
    let medium = Check.memory(of: machine(gibibytes: 3))
    #expect(medium.text.contains("-d preview to -d medium"))
    #expect(medium.text.contains("402 photos"))
    #expect(try #require(medium.remedy).contains("'-d full' have 4.2 GB"))
    let large = Check.memory(of: machine(gibibytes: 16))
    #expect(large.text.contains("every level of detail and for up to 2144 photos"))
  }

  @Test func theMemoryOfADryRunIsThatOfTheCheck() {
    for level in DetailArgument.allCases {
      let needed = DetailChoice.level(level).expectedMemoryBytes
      let fits = Check.memory(of: Machine(totalMemoryBytes: needed))
      let lacks = Check.memory(of: Machine(totalMemoryBytes: needed - 1))
      #expect(fits.status != .problem)
      #expect(fits != lacks)
    }
  }

  @Test func threadsAreLimitedByAffinityAndQuota() {
    func check(_ installed: Int, _ usable: Int, _ quota: Double?) -> Check {
      .threads(ProcessorShare(installed: installed, usable: usable, quota: quota))
    }
    #expect(check(8, 8, nil) == Check(.threads, .ok, "8 processors may be used."))
    #expect(check(1, 1, 4) == Check(.threads, .ok, "1 processor may be used."))
    let job = check(64, 4, nil)
    #expect(job.status == .note && job.text.hasPrefix("4 of 64 processors"))
    let container = check(8, 8, 1.5)
    #expect(container.status == .note && container.text.contains("1.5: a run has 2 threads"))
  }

  @Test func theBestInstructionsAreNamed() throws {
    let good = machine(gibibytes: 8, features: ["sse4_1", "sse4_2", "popcnt"])
    let all: [Instructions] = [.automatic, .portable, .avx2, .avx512, .avx512VNNI]
    let texts = (2...5).map { Check.instructions(Set(all.prefix($0)), of: good) }
    #expect(texts.map(\.status) == [.note, .ok, .ok, .ok])
    #expect(texts[0].text.contains("six times"))
    #expect(texts[1].text == "AVX2 is used." && texts[3].text == "AVX-512 with VNNI is used.")
    let old = Check.instructions([.portable], of: machine(gibibytes: 8, features: ["sse2"]))
    #expect(old.status == .problem && old.remedy?.contains("sse4_2") == true)
    let other = Check.instructions([.portable], of: machine(gibibytes: 8))
    #expect(other.status == .note && !other.text.contains("AVX2"))
  }

  private static let withoutRaw = "This program was built without camera raw."

  @Test func onlyJPEGAndPNGAreIndispensable() throws {
    let none = Check.imageFormats(failures: [:])
    #expect(none.status == .ok)
    #expect(
      none.text == "JPEG, PNG, HEIC, AVIF, TIFF, WebP, BMP, camera raw, OpenEXR were decoded.")
    let phone = Check.imageFormats(failures: [.heic: "no decoder"])
    #expect(phone.status == .note && phone.text.contains("HEIC can't be decoded (no decoder)"))
    #expect(try #require(phone.remedy).contains("libheif"))
    let part = Check.imageFormats(failures: [:], leftOut: [.cameraRaw])
    #expect(part.status == .ok && part.text.hasSuffix("OpenEXR were decoded. \(Self.withoutRaw)"))
    #expect(Check.imageFormats(failures: [.png: "", .heic: ""]).status == .problem)
    #expect(Check.imageFormats(failures: [.bmp: ""]).remedy?.contains("scripts/setup") == true)
  }

  @Test func temporaryFilesNeedSpace() throws {
    func check(_ gigabytes: Double?, inMemory: Bool = false, isWritable: Bool = true) -> Check {
      .temporaryFolder(
        FolderState(
          path: "/t", isWritable: isWritable, freeBytes: gigabytes.map { Int($0 * 1e9) },
          isInMemory: inMemory))
    }
    #expect(check(1000).status == .ok && check(1000).text.contains("every level"))
    #expect(check(5).status == .ok && check(5).text.contains("-d preview to -d medium"))
    #expect(check(1).status == .note && check(0.01).status == .problem)
    #expect(check(0.01, inMemory: true).status == .problem)
    let memory = check(100, inMemory: true)
    #expect(memory.status == .note && memory.remedy?.contains("/var/tmp") == true)
    #expect(check(1000, isWritable: false).status == .problem)
    #expect(check(nil).status == .ok)
  }

  @Test func theCurrentFolderIsNeverAProblem() {
    func check(_ bytes: Int?, isWritable: Bool) -> Check {
      .currentFolder(FolderState(path: "/c", isWritable: isWritable, freeBytes: bytes))
    }
    #expect(check(1 << 40, isWritable: true).status == .ok)
    #expect(check(nil, isWritable: true).status == .ok)
    #expect(check(1 << 20, isWritable: true).status == .note)
    #expect(check(1 << 40, isWritable: false).status == .note)
  }

  @Test func slurmIsANote() throws {
    #expect(Check.scheduler(environment: [:], hasBatchCommand: false) == nil)
    let node = try #require(Check.scheduler(environment: [:], hasBatchCommand: true))
    #expect(node.status == .note && node.remedy?.contains("srun") == true)
    let job = try #require(
      Check.scheduler(
        environment: ["SLURM_JOB_ID": "12", "SLURM_CPUS_PER_TASK": "4"], hasBatchCommand: false))
    #expect(job.status == .note && job.text.hasPrefix("This is Slurm job 12 with 4 processors"))
  }

  @Test(arguments: [
    (["TERM": "xterm", "LANG": "en_US.UTF-8"], nil),
    (["TERM": "xterm", "LC_ALL": "", "LANG": "de_DE.utf8"], nil),
    (["TERM": "xterm", "LC_ALL": "C", "LANG": "de_DE.utf8"], "locale C is"),
    (["TERM": "xterm"], "locale C is"), (["TERM": "dumb", "LANG": "C.UTF-8"], "redraw"),
    ([:], "redraw"),
  ])
  func onlyFaultsOfTheTerminalAreListed(_ environment: [String: String], words: String?) {
    let check = Check.terminal(environment: environment, isTerminal: true)
    #expect((check == nil) == (words == nil))
    if let words { #expect(check?.text.contains(words) == true && check?.status == .note) }
    #expect(Check.terminal(environment: environment, isTerminal: false) == nil)
  }

  @Test func sizesAreRoundedDown() {
    #expect(Check.gigabytes(2 << 30) == "2.1 GB")
    #expect(Check.gigabytes(99_999_999) == "0.0 GB")
    #expect(Check.gigabytes(123_456_789_012) == "123 GB")
  }
}
