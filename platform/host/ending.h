#pragma once

namespace platform::host {

/// Exit code of a process that Ctrl-C (SIGINT), SIGTERM or SIGHUP ended.
constexpr int interrupted_code = 130;

/// Sets what signals do to this process, once at its start: those that end it remove its part files
/// first; a pipe without reader and a file that grows too large are errors of writing, not signals.
void prepare_signals();

/// Ends the process because of `signal`, after removing its part files: with interrupted_code, or
/// as the system does after SIGQUIT. For signal handlers.
[[noreturn]] void end_by(int signal);

}  // namespace platform::host
