import Testing

@testable import Pipeline

@Suite struct ProcessorShareTests {
  @Test(arguments: [
    ("max 100000\n", nil), ("200000 100000\n", 2), ("50000 100000", 0.5), ("", nil), ("x y", nil),
    ("0 0", nil), ("-1 100000", nil), ("1 2 3", nil),
  ])
  func quotaIsParsed(_ text: String, quota: Double?) {
    #expect(ProcessorShare.quota(in: text) == quota)
  }

  @Test(arguments: [
    ("Name:\tx\nCpus_allowed_list:\t0-3,8\nMems: 1\n", 5), ("Cpus_allowed_list:\t7", 1), ("", nil),
    ("Cpus_allowed_list:\t", nil), ("Cpus_allowed_list:\t3-1", nil),
    ("Cpus_allowed_list:\t0-1-2", nil), ("Cpus_allowed_list:\t0,x", nil),
    ("Cpus_allowed_list:\t-", nil), ("Cpus_allowed_list:\t99999999999999999999", nil),
  ])
  func affinityIsParsed(_ text: String, count: Int?) {
    #expect(ProcessorShare.affinity(text) == count)
  }

  @Test func groupsAreListedFromTheOutermost() {
    let text = "1:name=systemd:/x\n0::/system.slice/job_1\n"
    #expect(
      ProcessorShare.controlGroups(text) == [
        "/sys/fs/cgroup", "/sys/fs/cgroup/system.slice", "/sys/fs/cgroup/system.slice/job_1",
      ])
    #expect(ProcessorShare.controlGroups("0::/\n") == ["/sys/fs/cgroup"])
    #expect(ProcessorShare.controlGroups("") == ["/sys/fs/cgroup"])
  }

  @Test(arguments: [(nil, 8), (0.2, 1), (2.5, 3), (100, 8), (Double.infinity, 8)])
  func threadsAreThoseThatCanWork(quota: Double?, threads: Int) {
    #expect(ProcessorShare(installed: 16, usable: 8, quota: quota).threads == threads)
  }

  @Test func thisProcessMayUseAProcessor() {
    let share = ProcessorShare.current
    #expect(share.usable >= 1 && share.usable <= share.installed && share.threads >= 1)
  }
}
