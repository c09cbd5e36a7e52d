#pragma once

#include <string>
#include <vector>

#include <sweep/results.h>
#include <sweep/store.h>

namespace platform::sweep {

/// Writes the results as a SQLite database, anew:
///
///   points(key, position, status, exit_code, signal, message, program, inputs)
///   parameters(key, path, value, number)  those that differ between points; number in base units
///   constants(path, value)                those that all points share
///   metrics(key, name, value)             a view of metric_values(position, metric, value) and
///                                         metric_names(id, name), which take a fifth of the room
///   runs(key, engine, host, date, attempt, wall_s, cpu_s)
///     only the key is known where the process was killed before it told
///   sweep(name, value)                    its title, file, program version
///
/// Throws vp::OutputError.
void write_database(const std::string& path, const Results& results,
                    const std::vector<RunEntry>& runs);

}  // namespace platform::sweep
