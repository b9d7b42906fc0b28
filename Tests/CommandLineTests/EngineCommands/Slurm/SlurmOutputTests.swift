import ArgumentParser
import Testing

@testable import EngineCommands

@Suite struct SlurmOutputTests {
  @Test func queueIsParsed() throws {
    let running = try #require(Slurm.job("photogrammetry-1a-views|12|3|RUNNING|s1|None"))
    #expect(running.name == "photogrammetry-1a-views" && running.id == "12" && running.task == 3)
    #expect(running.isRunning && running.node == "s1")
    let waiting = try #require(Slurm.job("photogrammetry-1a-join|13|N/A|PENDING||(Dependency)"))
    #expect(waiting.task == nil && !waiting.isRunning)
    #expect(Slurm.job("slurm_load_jobs error") == nil)
  }

  @Test func endOfAJobIsParsed() throws {
    let text =
      "JobId=3 ArrayJobId=1 ArrayTaskId=2 JobName=j UserId=root(0) JobState=OUT_OF_MEMORY "
      + "Reason=OutOfMemory Restarts=1 ExitCode=0:9 NodeList=s2 BatchHost=s2 Command=/a b.sh\n"
    let end = try #require(Slurm.end(text))
    #expect(end.state == "OUT_OF_MEMORY" && end.exitCode == "0:9" && end.node == "s2")
    #expect(Slurm.end("slurm_load_jobs error: Invalid job id specified") == nil)
  }

  @Test(arguments: [
    ("--qos=night --exclude=n7", ["--qos=night", "--exclude=n7"]),
    ("  --comment='two words'  -x \"a'b\" ''", ["--comment=two words", "-x", "a'b", ""]),
    ("", []),
  ])
  func optionsAreSplitAsByAShell(text: String, words: [String]) {
    #expect(SlurmArguments.words(of: text) == words)
  }

  @Test func optionsOfJobsNeedSlurm() throws {
    #expect(throws: (any Error).self) { try SlurmArguments.parse(["--partition", "short"]) }
    let arguments = try SlurmArguments.parse([
      "--slurm", "--partition", "short", "--account=a", "--slurm-options", "--qos=x",
    ])
    #expect(arguments.batchOptions == ["--partition=short", "--account=a", "--qos=x"])
  }
}
