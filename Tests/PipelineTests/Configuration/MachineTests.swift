import Testing

@testable import Pipeline

@Suite struct MachineTests {
  static let memory = "MemTotal:       16000000 kB\nMemFree: 1 kB\nMemAvailable:   8000000 kB\n"
  static let processor = "processor : 0\nflags\t\t: fpu sse4_1 sse4_2 popcnt avx2\nbugs : none\n"

  @Test func parsesTheKernelsFiles() {
    let machine = Machine(
      memory: Self.memory, processor: Self.processor, containerLimit: nil, containerUse: nil)
    #expect(machine.totalMemoryBytes == 16_000_000 * 1024)
    #expect(machine.availableMemoryBytes == 8_000_000 * 1024)
    #expect(machine.processorFeatures?.contains("avx2") == true)
    #expect(machine.shortfalls.isEmpty)
  }

  @Test func containerLimitsApply() throws {
    let machine = Machine(
      memory: Self.memory, processor: Self.processor, containerLimit: 3 << 30,
      containerUse: 2 << 30)
    #expect(machine.totalMemoryBytes == 3 << 30 && machine.availableMemoryBytes == 1 << 30)
    let sentence = try #require(machine.shortfalls.first)
    #expect(sentence.contains("1024 MB") && sentence.contains("2048 MB"))
  }

  @Test func missingProcessorFeaturesAreReported() throws {
    let machine = Machine(
      memory: Self.memory, processor: "flags : fpu sse2", containerLimit: nil, containerUse: nil)
    #expect(try #require(machine.shortfalls.first).contains("sse4_2"))
  }

  @Test func unparsableFilesAreNoShortfall() {
    let machine = Machine(memory: "", processor: "", containerLimit: nil, containerUse: nil)
    #expect(machine.processorFeatures == nil && machine.totalMemoryBytes > 0)
    #expect(machine.availableMemoryBytes == machine.totalMemoryBytes)
    #expect(!machine.shortfalls.contains { $0.contains("processor lacks") })
  }

  @Test func limitsFollowTheMemory() {
    let large = Machine(totalMemoryBytes: 16 << 30).limits
    #expect(large.maximumPhotos == 2144 && large.maximumPhotoSide == 16384)
    #expect(large.imageMemory == 1 << 30)
    #expect(large.surfaceMemory > large.imageMemory)
    let small = Machine(totalMemoryBytes: 2 << 30).limits
    #expect(small.maximumPhotos == 268 && small.maximumPhotoSide == 8192)
    #expect(small.imageMemory == 256 << 20)
    #expect(Machine(totalMemoryBytes: 1 << 40).limits.maximumPhotos == 65_535)
  }

  @Test func everyConfigurationIsWithinTheLimitsOfItsMachine() {
    let configuration = PipelineConfiguration(machine: Machine(totalMemoryBytes: 4 << 30))
    #expect(configuration.ingestion.maximumPhotos == 536)
    #expect(configuration.ingestion.inspection.limits.maximumSide == 8192)
    #expect(configuration.imageMemory == 512 << 20)
    let replaced = Machine.$override.withValue(Machine(totalMemoryBytes: 4 << 30)) {
      PipelineConfiguration()
    }
    #expect(replaced.ingestion == configuration.ingestion)
  }
}
