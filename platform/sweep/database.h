#pragma once

#include <string>

#include <sweep/results.h>
#include <sweep/run_log.h>

namespace platform::sweep {

/// Writes the results as a SQLite database, anew:
///
///   points(key, position, status, exit_code, signal, message, program, inputs, feasible)
///   parameters(key, path, value, number)  those that differ between points; number in base units
///   constants(path, value)                those that all points share
///   metrics(key, name, value)             a view of metric_names, whose `value` all points that
///   ran
///                                         share, or of metric_values, with 16 of the others a row
///   runs(key, engine, host, date, attempt, wall_s, cpu_s)
///     only the key is known where the process was killed before it told
///   sweep(name, value)                    its title, file, program version
///
/// Throws vp::OutputError.
void write_database(const std::string& path, const Results& results, const RunLogs& runs);

}  // namespace platform::sweep
