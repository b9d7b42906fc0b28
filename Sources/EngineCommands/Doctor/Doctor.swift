import ArgumentParser
import Foundation
import SharedCommands

/// Checks the machine.
struct Doctor: ParsableCommand {
  static let configuration = CommandConfiguration(
    commandName: "doctor",
    abstract: "Check whether this machine can make models, and what to improve.",
    discussion: """
      Prints one line per check with its status, and what to do about it:

        ok       nothing to do
        note     a run works, but something limits it or is worth knowing
        problem  a run can't be expected to work

      Checked are the build, memory, processors, instruction sets, image formats (each is \
      decoded), the folder for temporary files and the current folder; Slurm and the terminal if \
      there is something to know about them. Nothing is changed.

      EXAMPLES
        photogrammetry-cli doctor
        TMPDIR=/scratch photogrammetry-cli doctor
            Checks another folder for temporary files.

      JSON (with --json: one object)
        version   of the program
        isReady   whether no check has found a problem
        checks    a list of objects with
          name      version, memory, threads, instructions, imageFormats,
                    temporaryFolder, currentFolder, scheduler, terminal; the
                    last two may be missing, and more may be added
          status    ok, note or problem
          text      what was found
          remedy    what to do; missing if there is nothing to do

      Exit codes: 0 a run can be expected to work, 1 there is a problem, 2 invalid arguments.
      """)

  @Flag(name: .long, help: "Print one JSON object instead of a table.")
  var json = false

  mutating func run() throws {
    let report = DoctorReport.ofThisMachine()
    if json {
      Terminal.shared.result(try report.encoded())
    } else {
      report.lines.forEach(Terminal.shared.result)
    }
    guard report.isReady else { throw ExitCode(CommandFailure.runCode) }
  }
}
