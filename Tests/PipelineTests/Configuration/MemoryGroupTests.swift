import Testing

@testable import Pipeline

@Suite struct MemoryGroupTests {
  private func tightest(_ groups: String, _ files: [String: String]) -> MemoryGroup? {
    MemoryGroup.tightest(groups) { files[$0] ?? "" }
  }

  @Test func limitOfAJobCounts() {
    let job = "/sys/fs/cgroup/system.slice/slurmstepd.scope/job_7"
    let found = tightest(
      "0::/system.slice/slurmstepd.scope/job_7\n",
      [
        "/sys/fs/cgroup/memory.max": "max\n", job + "/memory.max": "3000\n",
        job + "/memory.current": "500\n", "/sys/fs/cgroup/system.slice/memory.max": "9000\n",
      ])
    #expect(found == MemoryGroup(limit: 3000, use: 500))
  }

  @Test func limitOfAContainerIsInItsRoot() {
    let found = tightest(
      "0::/\n",
      ["/sys/fs/cgroup/memory.max": "2048\n", "/sys/fs/cgroup/memory.current": "48\n"])
    #expect(found == MemoryGroup(limit: 2048, use: 48))
  }

  @Test func firstVersionIsRead() {
    let folder = "/sys/fs/cgroup/memory/slurm/uid_0/job_7"
    let found = tightest(
      "11:cpuset:/slurm\n9:memory:/slurm/uid_0/job_7\n",
      [folder + "/memory.limit_in_bytes": "700", folder + "/memory.usage_in_bytes": "100"])
    #expect(found == MemoryGroup(limit: 700, use: 100))
  }

  @Test(arguments: ["", "0::/\n", "garbage", "9:memory\n"])
  func withoutALimitThereIsNone(groups: String) {
    #expect(tightest(groups, [:]) == nil)
  }
}
