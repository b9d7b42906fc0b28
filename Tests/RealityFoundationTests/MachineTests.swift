import Testing

@testable import RealityFoundation

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
  }

  @Test func thisMachineIsSupportedAndHasLimits() {
    #expect(PhotogrammetrySession.isSupported)
    let big = PhotogrammetrySession.Limits(memoryBytes: 16 << 30)
    #expect(big.maximumNumberOfInputImages == 1000 && big.maximumInputImageDimension == 16384)
    let small = PhotogrammetrySession.Limits(memoryBytes: 2 << 30)
    #expect(small.maximumNumberOfInputImages == 268 && small.maximumInputImageDimension == 8192)
  }
}
