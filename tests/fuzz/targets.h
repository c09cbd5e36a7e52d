#pragma once

#include <functional>
#include <string>
#include <vector>

/// What reads files of strangers, one target a kind of file. Whatever the bytes are, a target ends
/// in bounded time, and either returns or throws one of the errors that the command line tells the
/// user (vp::InputError and what derives from it). Anything else is a finding.
namespace fuzz {

struct Target {
  std::string name;       ///< also the folder of its seeds in corpus/
  std::string extension;  ///< of the file that it reads: ".vcd"
  std::function<void(const std::string& path)> read;
};

const std::vector<Target>& targets();

/// Writes `bytes` to a file and lets the target read it; the errors that it may throw are caught.
/// Whether it was read without one.
bool feed(const Target& target, const std::string& bytes);

}  // namespace fuzz
