/// What ran, and where: so that a run can be repeated, and its times compared.
package struct RunDescription: Hashable, Codable, Sendable {
  /// The arguments, beginning with the name of the program.
  package var command: [String]
  /// The version of the program.
  package var program: String
  /// ISO 8601.
  package var started: String
  /// Wall-clock time until the report was written.
  package var seconds: Double
  /// The name of the folder of the photos.
  package var name: String
  /// The model's file or folder; nil if the command makes none.
  package var output: String?
  /// The operating system.
  package var system: String
  /// The model of the processor; nil if the system does not report it.
  package var processor: String?
  /// Number of cores that the process may use, and of threads that it used.
  package var cores: Int
  package var threads: Int
  package var memoryBytes: Int

  package init(
    command: [String], program: String, started: String, seconds: Double, name: String,
    output: String?, system: String, processor: String?, cores: Int, threads: Int, memoryBytes: Int
  ) {
    (self.command, self.program, self.started) = (command, program, started)
    (self.seconds, self.name, self.output) = (seconds, name, output)
    (self.system, self.processor, self.cores) = (system, processor, cores)
    (self.threads, self.memoryBytes) = (threads, memoryBytes)
  }
}
